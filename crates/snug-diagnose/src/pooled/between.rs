//! Sizes that lie between those of two groups: a tightening that has come the share w of the way has (1 − w) α₁ + w α₂, so that one
//! of its parameters depends on two of the shared sizes, and lies within bounds that both keep.

/// Puts into `values` what a part of the shared sizes makes of the model's parameters `common`, which may stand there twice in a row.
pub(super) fn mix(values: &mut [f64], common: &[usize], part: &[f64], shares: &[f64]) {
    for &index in common {
        values[index] = 0.0;
    }
    for ((&index, value), share) in common.iter().zip(part).zip(shares) {
        values[index] += share * value;
    }
}

/// Every index once.
pub(super) fn once(order: &[usize]) -> Vec<usize> {
    let mut once = order.to_vec();
    once.dedup();
    once
}

/// Where each index stands among those that are asked for once.
pub(super) fn places_in(order: &[usize]) -> impl Iterator<Item = usize> {
    order.iter().enumerate().scan(0, |place, (at, index)| {
        if at > 0 && order[at - 1] != *index {
            *place += 1;
        }
        Some(*place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of the way from 2 to 10 is 4.
    #[test]
    fn between_two_sizes_lies_what_has_come_part_of_the_way() {
        let mut values = [1.0, 0.0, 7.0, 0.0];
        mix(
            &mut values,
            &[1, 3, 3],
            &[5.0, 2.0, 10.0],
            &[1.0, 0.75, 0.25],
        );
        assert_eq!(values, [1.0, 5.0, 7.0, 4.0]);
    }

    #[test]
    fn what_stands_twice_is_asked_for_once() {
        let order = [0, 1, 4, 4, 6];
        assert_eq!(once(&order), [0, 1, 4, 6]);
        let places: Vec<usize> = places_in(&order).collect();
        assert_eq!(places, [0, 1, 2, 2, 3]);
    }
}
