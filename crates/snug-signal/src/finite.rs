//! Samples that are no numbers.

/// The first sample that is infinite or not a number, counted from 0.
pub fn first_not_finite(samples: &[f64]) -> Option<usize> {
    // Without a way out of it the loop runs in vector registers; nearly always it is all there is to do.
    let are_finite = samples.iter().fold(true, |all, x| all & x.is_finite());
    match are_finite {
        true => None,
        false => samples.iter().position(|x| !x.is_finite()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several() {
        assert_eq!(first_not_finite(&[]), None);
        assert_eq!(first_not_finite(&[1.0, -2.0]), None);
        assert_eq!(first_not_finite(&[1.0, f64::INFINITY, f64::NAN]), Some(1));
        assert_eq!(first_not_finite(&[f64::NAN]), Some(0));
    }
}
