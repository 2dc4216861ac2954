//! What an improvement leaves behind: verdict, report, study, and tables for other programs.

use super::whole::Rung;
use super::{Asked, Improved};
use crate::error::PlantError;
use crate::pooled::{GroupErrors, PooledOverAll};
use crate::storage::parquet_file;
use crate::storage::store::Store;
use arrow::array::{ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array};
use arrow::datatypes::{DataType, Field};
use snug_campaign::{EffectParameter, Factor, GroupSize};
use snug_diagnose::{FALSE_DISCOVERIES, SharedParameter};
use snug_model::{GroupValue, ParameterSettings};
use snug_statistics::descriptive::{mean, standard_deviation};
use snug_statistics::distributions::student_t_two_sided;
use snug_statistics::multiplicity::benjamini_hochberg;
use snug_study::{PreparedDiagnosis, Study};
use std::sync::Arc;

/// What groups rows that are known by their tool and its state.
const PLACE: &str = "tool";

/// What is written beside what the sample says.
pub(super) struct Outputs<'a> {
    pub rungs: &'a [Rung],
    pub asked: &'a Asked,
    /// Identity of the sample's rows.
    pub sample: RecordBatch,
}

/// Puts what all rows say in the place of what the sample says, and writes everything.
pub(super) async fn written(
    to: &Store,
    mut found: PreparedDiagnosis,
    outputs: Outputs<'_>,
) -> Result<Improved, PlantError> {
    let mut last = found.rungs.last().cloned().unwrap_or_default();
    let sampled = found.result.tightenings.len();
    let ladder = outputs.rungs.iter().map(|rung| {
        let error = rung.fit.as_ref().map_or(f64::NAN, PooledOverAll::error);
        (rung.study.model.effects.clone(), error)
    });
    let ladder: Vec<(Vec<String>, f64)> = ladder.collect();
    if let Some(diagnosis) = &mut found.result.diagnosis {
        for (told, rung) in diagnosis.ladder.iter_mut().zip(outputs.rungs) {
            let Ok(fit) = &rung.fit else { continue };
            match found.compared.is_over_noise {
                true => told.error_over_noise = Some(fit.error()),
                false => told.rms_fitted_output = fit.error(),
            }
        }
        if let Some(rung) = outputs.rungs.last()
            && let Ok(fit) = &rung.fit
        {
            let smallest_gain = last.diagnosis.search.smallest_gain_at_noise;
            let parameters = diagnosis
                .added
                .iter_mut()
                .flat_map(|one| &mut one.parameters);
            for parameter in parameters {
                let mut names = rung.shared.iter();
                if let Some(place) = names.position(|one| one.name == parameter.name) {
                    take(parameter, fit, place, (&rung.shared[place], smallest_gain));
                }
            }
            hold(&mut last, rung, fit);
        }
    }
    let study_ron = last.to_ron()?;
    found.result.study_ron.clone_from(&study_ron);
    to.put("study.ron", study_ron.into_bytes()).await?;
    to.put("sizes.parquet", sizes(outputs.rungs)?).await?;
    to.put("ladder.parquet", self::ladder(outputs.asked)?)
        .await?;
    let identity = outputs.sample.schema();
    let sample = parquet_file::written("sample", &identity, &[outputs.sample])?;
    to.put("sample.parquet", sample).await?;
    for (name, text) in snug_report::files(&found.result) {
        match name {
            "report.html" => to.put(name, text.into_bytes()).await?,
            "verdict.json" => to.put(name, with_plant(&text, outputs.asked)?).await?,
            _ => {}
        }
    }
    let diagnosis = found.result.diagnosis.as_ref();
    Ok(Improved {
        headline: diagnosis.map_or_else(String::new, |one| one.headline.to_string()),
        added: diagnosis.map_or_else(Vec::new, |one| {
            one.added.iter().map(|one| one.effect.clone()).collect()
        }),
        ladder,
        rows: 0,
        sampled,
        watched: None,
    })
}

/// The verdict with how the dataset was asked.
fn with_plant(verdict: &str, asked: &Asked) -> Result<Vec<u8>, PlantError> {
    let mut verdict: serde_json::Value = serde_json::from_str(verdict)?;
    if let Some(keys) = verdict.as_object_mut() {
        keys.insert("plant".to_owned(), serde_json::to_value(asked)?);
    }
    Ok(serde_json::to_vec_pretty(&verdict)?)
}

/// The ends of a size's interval, as far as it has any.
fn interval(
    value: f64,
    error: Option<f64>,
    of: &SharedParameter,
    fit: &PooledOverAll,
) -> (Option<f64>, Option<f64>) {
    let Some(error) = error else {
        return (None, None);
    };
    let limits = (of.minimum, of.maximum);
    let (low, high) = (of.nothing).interval_within(value, fit.quantile * error, limits);
    (Some(low), high)
}

/// A size of a group, or of all where that has none of its own.
fn value(fit: &PooledOverAll, place: usize, name: Option<&String>) -> f64 {
    let own = name.and_then(|name| fit.held.groups.get(name));
    own.unwrap_or(&fit.held.all)[place]
}

/// The groups that have an effect: told from nothing with so few false discoveries over the groups, and enough to matter. Of very many
/// rows what nobody could feel is told from nothing, too.
fn present(
    fit: &PooledOverAll,
    place: usize,
    (of, smallest_gain): (&SharedParameter, f64),
) -> Vec<String> {
    let chance = |group: &GroupErrors| {
        let away = of.nothing.distance(value(fit, place, group.name.as_ref()));
        let freedom = (group.members - 1.0).max(1.0);
        group.errors[place].map_or(1.0, |error| student_t_two_sided(away / error, freedom))
    };
    let may_be_nothing = |group: &GroupErrors| {
        let value = value(fit, place, group.name.as_ref());
        let (_, high) = interval(value, group.errors[place], of, fit);
        of.nothing.is_reached(high)
    };
    let chances: Vec<f64> = fit.groups.iter().map(chance).collect();
    let adjusted = benjamini_hochberg(&chances).unwrap_or_default();
    (fit.groups.iter().zip(adjusted))
        .filter(|(group, p)| *p <= FALSE_DISCOVERIES && group.shares[place] >= smallest_gain)
        .filter(|(group, _)| !may_be_nothing(group))
        .filter_map(|(group, _)| group.name.clone())
        .collect()
}

/// A parameter as all rows put it.
fn take(
    parameter: &mut EffectParameter,
    fit: &PooledOverAll,
    place: usize,
    (of, smallest_gain): (&SharedParameter, f64),
) {
    if let (true, Some(sizes)) = (fit.held.sharing.differs[place], &mut parameter.by_group) {
        let told = fit.groups.iter().filter_map(|group| {
            let value = value(fit, place, group.name.as_ref());
            let error = group.errors[place];
            let (low, high) = interval(value, error, of, fit);
            Some(GroupSize {
                group: group.name.clone()?,
                tightenings: group.members as usize,
                value,
                standard_error: error,
                shrunk: value,
                low,
                high,
                present: false,
            })
        });
        sizes.groups = told.collect();
        let present = present(fit, place, (of, smallest_gain));
        for group in &mut sizes.groups {
            group.present = present.contains(&group.group);
        }
        let values: Vec<f64> = sizes.groups.iter().map(|one| one.value).collect();
        parameter.value = mean(&values).unwrap_or(parameter.value);
        parameter.spread = standard_deviation(&values).ok();
        (parameter.low, parameter.high, parameter.standard_error) = (None, None, None);
        return;
    }
    let Some(group) = fit.groups.first() else {
        return;
    };
    let (value, error) = (value(fit, place, group.name.as_ref()), group.errors[place]);
    parameter.value = value;
    parameter.standard_error = error;
    (parameter.low, parameter.high) = interval(value, error, of, fit);
}

/// Holds the sizes in the study as all rows put them.
fn hold(study: &mut Study, rung: &Rung, fit: &PooledOverAll) {
    for (place, shared) in rung.shared.iter().enumerate() {
        let name = shared.name.clone();
        let told: &mut ParameterSettings = study.model.parameters.entry(name).or_default();
        let error = fit.groups.first().and_then(|group| group.errors[place]);
        told.value = Some(fit.held.all[place]);
        told.fixed = true;
        told.standard_error = error.or(Some(0.0));
        let Some(by) = &mut told.by_group else {
            continue;
        };
        by.values.clear();
        for group in &fit.groups {
            let Some(name) = &group.name else { continue };
            let value = GroupValue {
                value: fit.held.groups.get(name).unwrap_or(&fit.held.all)[place],
                standard_error: group.errors[place],
            };
            by.values.insert(name.clone(), value);
        }
    }
}

fn table(
    name: &str,
    columns: Vec<(&str, DataType, &str, ArrayRef)>,
) -> Result<Vec<u8>, PlantError> {
    let field = |(name, kind, told, _): &(&str, DataType, &str, ArrayRef)| {
        let about = [("description".to_owned(), (*told).to_owned())];
        Field::new(*name, kind.clone(), true).with_metadata(about.into())
    };
    let schema = crate::storage::schema::schema(name, columns.iter().map(field));
    let values = columns.into_iter().map(|(.., values)| values).collect();
    let batch = RecordBatch::try_new(schema.clone(), values).map_err(PlantError::columns(name))?;
    parquet_file::written(name, &schema, &[batch])
}

fn texts(values: impl Iterator<Item = Option<String>>) -> ArrayRef {
    Arc::new(values.collect::<StringArray>())
}

fn numbers(values: impl Iterator<Item = Option<f64>>) -> ArrayRef {
    Arc::new(values.collect::<Float64Array>())
}

/// The ladder as a table: a row a rung.
fn ladder(asked: &Asked) -> Result<Vec<u8>, PlantError> {
    use DataType::{Boolean, Float64, UInt32, Utf8};
    let all = || asked.ladder.iter();
    let count = |value: usize| u32::try_from(value).ok();
    let place: ArrayRef = Arc::new(
        all()
            .enumerate()
            .map(|(at, _)| count(at))
            .collect::<UInt32Array>(),
    );
    let passes = all()
        .map(|one| one.passes.and_then(count))
        .collect::<UInt32Array>();
    let converged = all().map(|one| one.converged).collect::<BooleanArray>();
    table(
        "ladder",
        vec![
            ("rung", UInt32, "0 is the model at first", place),
            (
                "effects",
                Utf8,
                "effects in the model, joined by +",
                texts(all().map(|one| Some(one.effects.join("+")))),
            ),
            (
                "rows",
                Float64,
                "rows that took part",
                numbers(all().map(|one| one.rows)),
            ),
            (
                "left_out",
                Float64,
                "rows that could not be compared as the sample is, or not be fitted",
                numbers(all().map(|one| one.left_out)),
            ),
            (
                "error_over_noise",
                Float64,
                "root mean square of the whitened residual of all rows: 1 is nothing left but noise; in the output's unit where the noise is not known",
                numbers(all().map(|one| one.error_over_noise)),
            ),
            (
                "sample_error_over_noise",
                Float64,
                "the same of the sample",
                numbers(all().map(|one| one.sample_error_over_noise)),
            ),
            (
                "passes",
                UInt32,
                "passes over the dataset",
                Arc::new(passes),
            ),
            (
                "converged",
                Boolean,
                "whether the sizes are where the cost of all rows is least",
                Arc::new(converged),
            ),
            (
                "not_fitted",
                Utf8,
                "why this rung was not fitted to all rows",
                texts(all().map(|one| one.not_fitted.clone())),
            ),
        ],
    )
}

/// A size as a row.
struct Size {
    rung: u32,
    name: String,
    factor: Option<String>,
    group: Option<String>,
    rows: f64,
    value: f64,
    error: Option<f64>,
    share: f64,
    low: Option<f64>,
    high: Option<f64>,
}

/// The sizes that rows share, a row a size, or a size and a group, of every rung.
fn sizes(rungs: &[Rung]) -> Result<Vec<u8>, PlantError> {
    use DataType::{Float64, UInt32, Utf8};
    let all = size_rows(rungs);
    let each = || all.iter();
    table(
        "sizes",
        vec![
            (
                "rung",
                UInt32,
                "of the ladder; 0 is the model at first",
                Arc::new(each().map(|one| Some(one.rung)).collect::<UInt32Array>()),
            ),
            (
                "parameter",
                Utf8,
                "name with unit",
                texts(each().map(|one| Some(one.name.clone()))),
            ),
            (
                "differs_by",
                Utf8,
                "what groups rows whose sizes differ; null where all share one",
                texts(each().map(|one| one.factor.clone())),
            ),
            (
                "group",
                Utf8,
                "which group; null where all share one",
                texts(each().map(|one| one.group.clone())),
            ),
            (
                "rows",
                Float64,
                "rows that have this size",
                numbers(each().map(|one| Some(one.rows))),
            ),
            (
                "value",
                Float64,
                "in the parameter's unit",
                numbers(each().map(|one| Some(one.value))),
            ),
            (
                "standard_error",
                Float64,
                "null on a bound, and where the rows know nothing of it",
                numbers(each().map(|one| one.error)),
            ),
            (
                "share",
                Float64,
                "by what share of these rows' squared residual it would rise without this size",
                numbers(each().map(|one| Some(one.share))),
            ),
            (
                "low",
                Float64,
                "lower end of the 95 % interval",
                numbers(each().map(|one| one.low)),
            ),
            (
                "high",
                Float64,
                "upper end of the 95 % interval; null where it may be without end, as a mass that hardly moves",
                numbers(each().map(|one| one.high)),
            ),
        ],
    )
}

fn size_rows(rungs: &[Rung]) -> Vec<Size> {
    let mut all: Vec<Size> = Vec::new();
    for (number, rung) in (0..).zip(rungs) {
        let Ok(fit) = &rung.fit else { continue };
        for (place, shared) in rung.shared.iter().enumerate() {
            let differs = fit.held.sharing.differs[place];
            for group in fit.groups.iter().take(if differs { usize::MAX } else { 1 }) {
                let value = value(fit, place, group.name.as_ref());
                let (low, high) = interval(value, group.errors[place], shared, fit);
                let factor = fit.held.sharing.factor.as_ref().filter(|_| differs);
                all.push(Size {
                    rung: number,
                    name: shared.name.clone(),
                    factor: factor.map(|factor| match factor {
                        Factor::File => PLACE.to_owned(),
                        other => other.to_string(),
                    }),
                    group: group.name.clone().filter(|_| differs),
                    rows: if differs {
                        group.members
                    } else {
                        fit.totals.members
                    },
                    value,
                    error: group.errors[place],
                    share: group.shares[place],
                    low,
                    high,
                });
            }
        }
    }
    all
}
