//! `snug_fit(study, columns …)`: Snug's fit as a function of the engine, the same on every machine that has it.

use super::outcome::{self, Outcome};
use super::results;
use crate::rows;
use crate::storage::schema::{IDENTITY, PREPARED, field};
use arrow::array::{Array, ArrayRef, RecordBatch};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Field, FieldRef, Schema, SchemaRef};
use datafusion::common::{DataFusionError, ScalarValue, exec_err, plan_err};
use datafusion::logical_expr::{
    ColumnarValue, ReturnFieldArgs, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature,
    Volatility,
};
use snug_campaign::TighteningResult;
use snug_identify::{IdentifyError, SIDE_BY_SIDE};
use snug_preprocess::Prepared;
use snug_study::{Study, fit_numbers};
use std::path::Path;
use std::sync::{Arc, LazyLock, Mutex};

/// The function's name in plans and queries.
pub(crate) const NAME: &str = "snug_fit";

/// Columns of [`IDENTITY`] that a fit has no use for.
const NOT_TAKEN: [&str; 5] = ["key", "day", "tool", "station", "time_of_day_s"];

/// The columns that it takes behind the study, in this order.
pub(crate) static TAKEN: LazyLock<SchemaRef> = LazyLock::new(|| {
    let columns = IDENTITY
        .iter()
        .filter(|(name, ..)| !NOT_TAKEN.contains(name));
    let fields = columns
        .chain(PREPARED)
        .map(|(name, kind, nullable, _)| field(name, *kind, *nullable, ""));
    Arc::new(Schema::new(fields.collect::<Vec<Field>>()))
});

/// The function.
pub(crate) fn function() -> ScalarUDF {
    ScalarUDF::from(Fit {
        signature: Signature::any(1 + TAKEN.fields().len(), Volatility::Immutable),
    })
}

#[derive(Debug, PartialEq, Eq, Hash)]
struct Fit {
    signature: Signature,
}

impl ScalarUDFImpl for Fit {
    fn name(&self) -> &str {
        NAME
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType, DataFusionError> {
        plan_err!("what {NAME} answers depends on the study")
    }

    fn return_field_from_args(
        &self,
        args: ReturnFieldArgs<'_>,
    ) -> Result<FieldRef, DataFusionError> {
        let study = study(args.scalar_arguments.first().copied().flatten())?;
        let fields = results::outcome(&study).map_err(external)?;
        Ok(Arc::new(Field::new(NAME, DataType::Struct(fields), true)))
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue, DataFusionError> {
        let Some(ColumnarValue::Scalar(text)) = args.args.first() else {
            return exec_err!("the first argument of {NAME} is the study, as a literal");
        };
        let study = study(Some(text))?;
        let batch = taken(&TAKEN, &args.args[1..], args.number_rows)?;
        let prepared = rows::prepared(&batch)?;
        let outcomes = fitted(&study, &prepared)?;
        let fields = results::outcome(&study).map_err(external)?;
        let parameters = results::model(&study).map_err(external)?.parameters().len();
        let answer = outcome::columns(&fields, parameters, &outcomes)?;
        Ok(ColumnarValue::Array(Arc::new(answer)))
    }
}

pub(crate) fn external(error: impl std::error::Error + Send + Sync + 'static) -> DataFusionError {
    DataFusionError::External(Box::new(error))
}

/// The batch of what a function was given, in the types of the columns that it takes.
pub(crate) fn taken(
    schema: &SchemaRef,
    args: &[ColumnarValue],
    rows: usize,
) -> Result<RecordBatch, DataFusionError> {
    let columns = args.iter().zip(schema.fields()).map(|(arg, field)| {
        let array = arg.to_array(rows)?;
        let array: ArrayRef = match array.data_type() == field.data_type() {
            true => array,
            false => cast(&array, field.data_type())?,
        };
        Ok(array)
    });
    let columns = columns.collect::<Result<Vec<_>, DataFusionError>>()?;
    let is_null =
        |(field, column): &(&FieldRef, &ArrayRef)| !field.is_nullable() && column.null_count() > 0;
    if let Some((field, _)) = schema.fields().iter().zip(&columns).find(is_null) {
        return exec_err!(
            "column {} of the dataset is null, which it may not be",
            field.name()
        );
    }
    Ok(RecordBatch::try_new(schema.clone(), columns)?)
}

/// Fits every row.
fn fitted(study: &Study, prepared: &[Prepared]) -> Result<Vec<Outcome>, DataFusionError> {
    in_lanes(prepared, |side_by_side| {
        let outcomes = fit_numbers(study, side_by_side).map_err(external)?;
        let outcome =
            |one: Result<TighteningResult, IdentifyError>| one.map_err(|error| error.to_string());
        Ok(outcomes.into_iter().map(outcome).collect())
    })
}

/// What `work` makes of as many side by side as fill the lanes of vector registers, those of about the same length together; in the
/// order of the rows.
pub(crate) fn in_lanes<T>(
    prepared: &[Prepared],
    work: impl Fn(&[&Prepared]) -> Result<Vec<T>, DataFusionError>,
) -> Result<Vec<T>, DataFusionError> {
    let mut order: Vec<usize> = (0..prepared.len()).collect();
    order.sort_by_key(|&row| prepared[row].tightening.torque_nm.len());
    let mut found: Vec<Option<T>> = prepared.iter().map(|_| None).collect();
    for some in order.chunks(SIDE_BY_SIDE) {
        let side_by_side: Vec<&Prepared> = some.iter().map(|&row| &prepared[row]).collect();
        for (&row, one) in some.iter().zip(work(&side_by_side)?) {
            found[row] = Some(one);
        }
    }
    Ok(found.into_iter().flatten().collect())
}

/// The study that a literal says; the latest is kept, as one job asks for it with every batch.
pub(crate) fn study(literal: Option<&ScalarValue>) -> Result<Arc<Study>, DataFusionError> {
    static LATEST: Mutex<Option<(String, Arc<Study>)>> = Mutex::new(None);
    let Some(Some(text)) = literal.and_then(ScalarValue::try_as_str) else {
        return plan_err!("the first argument of {NAME} is the study, as a literal");
    };
    let mut latest = LATEST
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some((known, study)) = &*latest
        && known == text
    {
        return Ok(Arc::clone(study));
    }
    let read = Study::parse(text, Path::new("the dataset's study")).map_err(external)?;
    let read = Arc::new(read);
    *latest = Some((text.to_owned(), Arc::clone(&read)));
    Ok(read)
}
