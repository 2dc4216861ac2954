//! `snug_block(study, sizes, columns …)` and `snug_group(sizes, columns …)`: what a row says of the sizes that it shares, and whose
//! they are.

use super::fit::{TAKEN, external, in_lanes, study, taken};
use super::question::{Held, Totals};
use super::sum::list_type;
use crate::rows;
use crate::storage::partition::COLUMNS;
use crate::storage::schema::{IDENTITY, field};
use arrow::array::{ArrayRef, Float64Builder, ListBuilder, StringArray};
use arrow::datatypes::{DataType, Schema, SchemaRef};
use datafusion::common::{DataFusionError, ScalarValue, exec_err, plan_err};
use datafusion::logical_expr::{
    ColumnarValue, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature, Volatility,
};
use snug_preprocess::Prepared;
use snug_study::shared_blocks;
use std::sync::{Arc, LazyLock};

/// Columns that say which group a row belongs to: a row is known by its tool and that tool's state, as a sample's are.
const GROUPING: [&str; 7] = [
    "day",
    "tool",
    "participant",
    "strategy",
    "joint",
    "pace_per_min",
    "target_torque_nm",
];

/// Their schema.
pub(crate) static GROUPED: LazyLock<SchemaRef> = LazyLock::new(|| {
    let columns = IDENTITY.iter().filter(|(name, ..)| GROUPING.contains(name));
    let fields = columns.map(|(name, kind, nullable, _)| field(name, *kind, *nullable, ""));
    Arc::new(Schema::new(fields.collect::<Vec<_>>()))
});

/// What a fit takes, and by what rows are known.
pub(crate) static ASKED: LazyLock<SchemaRef> = LazyLock::new(|| {
    let place = |name: &&str| IDENTITY.iter().find(|(known, ..)| known == name);
    let beside = COLUMNS.iter().filter_map(place);
    let beside = beside.map(|(name, kind, nullable, _)| field(name, *kind, *nullable, ""));
    let taken = TAKEN.fields().iter().map(|field| field.as_ref().clone());
    Arc::new(Schema::new(taken.chain(beside).collect::<Vec<_>>()))
});

/// What a row says of the sizes.
pub(crate) fn block_function() -> ScalarUDF {
    ScalarUDF::from(Block {
        signature: Signature::any(2 + ASKED.fields().len(), Volatility::Immutable),
    })
}

/// Which group's sizes a row has.
pub(crate) fn group_function() -> ScalarUDF {
    ScalarUDF::from(Group {
        signature: Signature::any(1 + GROUPED.fields().len(), Volatility::Immutable),
    })
}

/// The sizes that a literal holds.
fn held(literal: Option<&ColumnarValue>) -> Result<Held, DataFusionError> {
    match literal {
        Some(ColumnarValue::Scalar(value)) => match value.try_as_str() {
            Some(Some(text)) => serde_json::from_str(text).map_err(external),
            _ => plan_err!("sizes are a literal text"),
        },
        _ => plan_err!("sizes are a literal text"),
    }
}

#[derive(Debug, PartialEq, Eq, Hash)]
struct Block {
    signature: Signature,
}

impl ScalarUDFImpl for Block {
    fn name(&self) -> &str {
        "snug_block"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType, DataFusionError> {
        Ok(list_type())
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue, DataFusionError> {
        let Some(ColumnarValue::Scalar(text)) = args.args.first() else {
            return exec_err!("the first argument of {} is the study", self.name());
        };
        let text: &ScalarValue = text;
        let study = study(Some(text))?;
        let held = held(args.args.get(1))?;
        let batch = taken(&ASKED, &args.args[2..], args.number_rows)?;
        let mut prepared = rows::prepared(&batch)?;
        let names = rows::names_of(&batch, &|tool, day| held.states.name(tool, day))?;
        for (one, name) in prepared.iter_mut().zip(names) {
            one.tightening.id.file = name;
        }
        let p = held.all.len();
        let totals = in_lanes(&prepared, |some: &[&Prepared]| {
            let blocks = shared_blocks(&study, held.compared, some, &|one| held.of(one));
            let blocks = blocks.map_err(external)?.into_iter();
            Ok(blocks.map(|block| Totals::of(p, block.as_ref())).collect())
        })?;
        let mut lists = ListBuilder::new(Float64Builder::new());
        for one in totals {
            lists.values().append_slice(&one.into_list());
            lists.append(true);
        }
        Ok(ColumnarValue::Array(Arc::new(lists.finish())))
    }
}

#[derive(Debug, PartialEq, Eq, Hash)]
struct Group {
    signature: Signature,
}

impl ScalarUDFImpl for Group {
    fn name(&self) -> &str {
        "snug_group"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType, DataFusionError> {
        Ok(DataType::Utf8)
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue, DataFusionError> {
        let held = held(args.args.first())?;
        let batch = taken(&GROUPED, &args.args[1..], args.number_rows)?;
        let names = rows::names_of(&batch, &|tool, day| held.states.name(tool, day))?;
        let groups = rows::conditions(&batch)?.into_iter().zip(names);
        let groups = groups.map(|(mut one, name)| {
            one.id.file = name;
            held.group(&one)
        });
        let groups: ArrayRef = Arc::new(groups.collect::<StringArray>());
        Ok(ColumnarValue::Array(groups))
    }
}
