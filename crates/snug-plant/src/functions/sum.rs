//! `snug_sum(list)`: lists added up place by place, exactly, so that the sum has the same bits in whatever order rows and parts come.
//!
//! Each place keeps its sum as an expansion of parts that do not overlap (Shewchuk 1997, Adaptive precision floating-point arithmetic,
//! grow-expansion), rounded once at the end.

use arrow::array::{Array, ArrayRef, AsArray, Float64Array, ListArray};
use arrow::buffer::OffsetBuffer;
use arrow::datatypes::{DataType, Field, FieldRef, Float64Type};
use datafusion::common::{DataFusionError, ScalarValue, exec_err};
use datafusion::logical_expr::function::{AccumulatorArgs, StateFieldsArgs};
use datafusion::logical_expr::{
    Accumulator, AggregateUDF, AggregateUDFImpl, Signature, Volatility,
};
use std::sync::Arc;

/// The function's name in plans and queries.
pub(crate) const NAME: &str = "snug_sum";

/// The function.
pub(crate) fn sum_function() -> AggregateUDF {
    AggregateUDF::from(Sum {
        signature: Signature::exact(vec![list_type()], Volatility::Immutable),
    })
}

/// Lists of numbers.
pub(crate) fn list_type() -> DataType {
    DataType::List(Arc::new(Field::new_list_field(DataType::Float64, true)))
}

/// One list as a column of one row.
pub(crate) fn list(values: Vec<f64>) -> ListArray {
    let offsets = OffsetBuffer::from_lengths([values.len()]);
    let item = Arc::new(Field::new_list_field(DataType::Float64, true));
    ListArray::new(item, offsets, Arc::new(Float64Array::from(values)), None)
}

#[derive(Debug, PartialEq, Eq, Hash)]
struct Sum {
    signature: Signature,
}

impl AggregateUDFImpl for Sum {
    fn name(&self) -> &str {
        NAME
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType, DataFusionError> {
        Ok(list_type())
    }

    fn accumulator(&self, _: AccumulatorArgs<'_>) -> Result<Box<dyn Accumulator>, DataFusionError> {
        Ok(Box::new(Places::default()))
    }

    fn state_fields(&self, args: StateFieldsArgs<'_>) -> Result<Vec<FieldRef>, DataFusionError> {
        let name = format!("{}[parts]", args.name);
        Ok(vec![Arc::new(Field::new(name, list_type(), true))])
    }
}

/// The sums of every place of the lists.
#[derive(Debug, Default)]
pub(crate) struct Places(Vec<ExactSum>);

impl Places {
    /// Adds what another's state says: place by place how many parts, and these.
    pub fn merge(&mut self, state: &[f64]) {
        let (mut rest, mut place) = (state, 0);
        while let Some((&count, after)) = rest.split_first() {
            let (parts, next) = after.split_at((count as usize).min(after.len()));
            for part in parts {
                self.at(place).add(*part);
            }
            // A place without parts is one all the same: its sum is 0.
            self.at(place);
            (rest, place) = (next, place + 1);
        }
    }

    /// The sums, each rounded once.
    pub fn sums(&self) -> Vec<f64> {
        self.0.iter().map(ExactSum::value).collect()
    }

    fn at(&mut self, place: usize) -> &mut ExactSum {
        if self.0.len() <= place {
            self.0.resize_with(place + 1, ExactSum::default);
        }
        &mut self.0[place]
    }
}

/// Every list of a column that is there.
fn each(values: &[ArrayRef], mut take: impl FnMut(&[f64])) -> Result<(), DataFusionError> {
    let Some(lists) = values
        .first()
        .and_then(|column| column.as_list_opt::<i32>())
    else {
        return exec_err!("{NAME} adds up lists of numbers");
    };
    for row in (0..lists.len()).filter(|&row| lists.is_valid(row)) {
        let list = lists.value(row);
        let Some(numbers) = list.as_primitive_opt::<Float64Type>() else {
            return exec_err!("{NAME} adds up lists of numbers");
        };
        take(numbers.values());
    }
    Ok(())
}

impl Accumulator for Places {
    fn update_batch(&mut self, values: &[ArrayRef]) -> Result<(), DataFusionError> {
        each(values, |list| {
            for (place, value) in list.iter().enumerate() {
                self.at(place).add(*value);
            }
        })
    }

    fn evaluate(&mut self) -> Result<ScalarValue, DataFusionError> {
        Ok(ScalarValue::List(Arc::new(list(self.sums()))))
    }

    fn size(&self) -> usize {
        let parts: usize = self.0.iter().map(|sum| sum.0.capacity()).sum();
        size_of_val(self) + self.0.capacity() * size_of::<ExactSum>() + parts * size_of::<f64>()
    }

    /// As [`Places::merge`] takes it.
    fn state(&mut self) -> Result<Vec<ScalarValue>, DataFusionError> {
        let mut flat = Vec::new();
        for sum in &self.0 {
            flat.push(sum.0.len() as f64);
            flat.extend_from_slice(&sum.0);
        }
        Ok(vec![ScalarValue::List(Arc::new(list(flat)))])
    }

    fn merge_batch(&mut self, states: &[ArrayRef]) -> Result<(), DataFusionError> {
        each(states, |state| self.merge(state))
    }
}

/// A sum kept without error: parts that do not overlap, the smallest first.
#[derive(Debug, Clone, Default)]
struct ExactSum(Vec<f64>);

impl ExactSum {
    fn add(&mut self, value: f64) {
        let mut sum = value;
        let mut kept = 0;
        for index in 0..self.0.len() {
            let part = self.0[index];
            let (large, small) = match sum.abs() < part.abs() {
                true => (part, sum),
                false => (sum, part),
            };
            let high = large + small;
            let low = small - (high - large);
            if low != 0.0 {
                self.0[kept] = low;
                kept += 1;
            }
            sum = high;
        }
        self.0.truncate(kept);
        self.0.push(sum);
    }

    /// The sum, rounded once, to even where it stands between two.
    fn value(&self) -> f64 {
        let mut parts = self.0.iter().rev();
        let mut high = parts.next().copied().unwrap_or(0.0);
        let mut low = 0.0;
        for part in parts.by_ref() {
            let before = high;
            high = before + part;
            low = part - (high - before);
            if low != 0.0 {
                break;
            }
        }
        let goes_on = parts
            .next()
            .is_some_and(|next| (low < 0.0) == (*next < 0.0));
        if low != 0.0 && goes_on {
            let twice = 2.0 * low;
            let further = high + twice;
            if twice == further - high {
                return further;
            }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn sum(values: &[f64]) -> f64 {
        let mut sum = ExactSum::default();
        values.iter().for_each(|value| sum.add(*value));
        sum.value()
    }

    /// Against Python's `math.fsum`.
    #[test]
    fn sums_are_exact_and_rounded_once() {
        assert_eq!(sum(&[]), 0.0);
        assert_eq!(sum(&[0.1; 10]), 1.0);
        assert_eq!(sum(&[1e16, 1.0, 1e-16]), 10_000_000_000_000_002.0);
        assert_eq!(sum(&[1e308, 1.0, -1e308]), 1.0);
        assert_eq!(sum(&[1.0, 1e100, 1.0, -1e100]), 2.0);
    }

    /// Parts of a column, in other orders and cut otherwise, come to the same bits.
    #[test]
    fn parts_in_any_order_have_the_same_bits() {
        let value = |k: u64| (k as f64 * 0.731).sin() * 10_f64.powi((k % 23) as i32 - 11);
        let rows: Vec<ListArray> = (0..200)
            .map(|k| list(vec![value(k), value(k + 7), 1.0]))
            .collect();
        let total = |order: &[usize], parts: usize| {
            let mut all = Places::default();
            for part in order.chunks(order.len().div_ceil(parts)) {
                let mut own = Places::default();
                for &row in part {
                    own.update_batch(&[Arc::new(rows[row].clone())]).unwrap();
                }
                let state = own.state().unwrap().remove(0).to_array().unwrap();
                all.merge_batch(&[state]).unwrap();
            }
            all.evaluate().unwrap()
        };
        let forth: Vec<usize> = (0..200).collect();
        let back: Vec<usize> = (0..200).rev().collect();
        let expected = total(&forth, 1);
        assert_eq!(total(&forth, 7), expected);
        assert_eq!(total(&back, 13), expected);
        let naive: f64 = (0..200).map(value).sum();
        let ScalarValue::List(lists) = expected else {
            panic!()
        };
        let numbers = lists.value(0);
        let numbers = numbers.as_primitive::<Float64Type>();
        assert!((numbers.value(0) - naive).abs() < 1e-4 * naive.abs());
        assert_eq!(numbers.value(2), 200.0);
    }
}
