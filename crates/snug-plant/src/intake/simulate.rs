//! A plant of simulated tools straight into a dataset, some of which an effect comes over on some day.

use crate::error::PlantError;
use crate::intake::import::{Growing, Imported, Read};
use crate::intake::naming::Named;
use crate::storage::dataset::{Dataset, digest};
use crate::storage::partition::{Partition, date_of, days_since_1970};
use crate::storage::store::Store;
use rayon::prelude::*;
use snug_preprocess::preprocess;
use snug_study::{FileTightenings, Study};
use snug_synthetic::{
    CampaignPlan, ChannelNames, FilePlan, HiddenEffect, Joint, Strategy, SyntheticFile, Whose,
    simulate_part,
};
use std::ops::Range;

/// What is simulated.
#[derive(Debug, Clone)]
pub struct Simulation {
    /// Tools.
    pub tools: usize,
    /// Days in a row.
    pub days: usize,
    /// The first of them, YYYY-MM-DD.
    pub first_day: String,
    /// Tightenings of a tool on a day.
    pub per_day: usize,
    /// The effect that comes over some tools, by its name; none for a plant where nothing happens.
    pub effect: Option<String>,
    /// How strong it is, 0 to 1, without unit.
    pub strength: f64,
    /// Numbers of the tools that have it, from 1.
    pub in_tools: Vec<u32>,
    /// The day from which they have it, from 1.
    pub from_day: usize,
    /// Samples per second \[Hz\].
    pub sample_rate_hz: f64,
    /// What decides everything random.
    pub seed: u64,
}

impl Default for Simulation {
    fn default() -> Self {
        Self {
            tools: 12,
            days: 20,
            first_day: "2026-03-01".to_owned(),
            per_day: 20,
            effect: None,
            strength: 0.5,
            in_tools: vec![3, 7, 10],
            from_day: 11,
            sample_rate_hz: 10_000.0,
            seed: 1,
        }
    }
}

/// Puts a simulated plant into the dataset at `to`. Every day other people hold the tools.
///
/// # Errors
/// [`PlantError::Setting`] and [`PlantError::Synthetic`] for what cannot be simulated.
pub async fn simulate_plant(simulation: &Simulation, to: Store) -> Result<Imported, PlantError> {
    let first = days_since_1970(&simulation.first_day).ok_or_else(|| {
        PlantError::setting(
            "first day",
            &simulation.first_day,
            "YYYY-MM-DD, from 1970-01-01 on",
        )
    })?;
    let effect = simulation
        .effect
        .as_deref()
        .map(HiddenEffect::from_name)
        .transpose()?;
    let study = Study::default();
    let dataset = Dataset::make(to, "tightenings", &study).await?;
    let mut imported = Imported::default();
    for day in 0..simulation.days {
        let effect = effect.filter(|_| day + 1 >= simulation.from_day);
        let day = Day {
            plan: plan(simulation, effect),
            seed: (simulation.seed.wrapping_mul(1_000_003)).wrapping_add(day as u64),
            date: date_of(first + day as i32),
            study: &study,
        };
        day.put(&dataset, &mut imported).await?;
    }
    Ok(imported)
}

/// Tightenings that are simulated as one file: at 10 kHz some 20 MB of recording.
const AT_ONCE: usize = 128;

/// A day of all tools.
struct Day<'a> {
    plan: CampaignPlan,
    seed: u64,
    date: String,
    study: &'a Study,
}

/// The number of a tool's file, from 0, and which of its tightenings.
type Part = (usize, Range<usize>);

impl Day<'_> {
    /// Every tool's partition, one after another: of each only some parts are in memory.
    async fn put(&self, dataset: &Dataset, imported: &mut Imported) -> Result<(), PlantError> {
        let parts_of = |(number, file): (usize, &FilePlan)| {
            let last = file.tightenings;
            let starts = (0..last).step_by(AT_ONCE);
            starts.map(move |start| (number, start..last.min(start + AT_ONCE)))
        };
        let parts: Vec<Part> = (self.plan.files.iter().enumerate())
            .flat_map(parts_of)
            .collect();
        let mut growing: Option<(usize, Growing<'_>)> = None;
        for some in parts.chunks(rayon::current_num_threads()) {
            let made = some.par_iter().map(|part| Ok((part.0, self.part(part)?)));
            for (number, read) in made.collect::<Result<Vec<_>, PlantError>>()? {
                if growing.as_ref().is_none_or(|(known, _)| *known != number) {
                    if let Some((_, whole)) = growing.take() {
                        whole.finish(imported).await?;
                    }
                    let partition = read.1.partition.clone();
                    let before = dataset.commit_of(&partition).await?.unwrap_or_default();
                    growing = Some((number, Growing::new(dataset, partition, before)));
                }
                if let Some((_, growing)) = &mut growing {
                    growing.take(vec![read], imported).await?;
                }
            }
        }
        match growing {
            Some((_, whole)) => whole.finish(imported).await,
            None => Ok(()),
        }
    }

    fn part(&self, (number, tightenings): &Part) -> Result<Read, PlantError> {
        let tool = number + 1;
        let named = Named {
            partition: Partition::new(&self.date, &format!("T{tool:04}"))?,
            station: Some(format!("S{:02}", number / 4 + 1)),
            time_of_day_s: Some(6.0 * 3600.0),
        };
        let (plan, seed) = (&self.plan, self.seed);
        // A file of one part is called as a file is; parts of a longer one have their number.
        let part = match tightenings.start / AT_ONCE {
            0 => String::new(),
            behind => format!("_{}", behind + 1),
        };
        let file = simulate_part(plan, *number, tightenings.clone(), seed)?;
        let source = digest(format!("{seed} {plan:?} {}{part}", named.partition).as_bytes());
        let name = format!("{}_{}{part}.mat", named.partition.tool, named.partition.day);
        let file = file_tightenings(self.study, &file, name)?;
        Ok((source, named, file))
    }
}

fn file_tightenings(
    study: &Study,
    file: &SyntheticFile,
    name: String,
) -> Result<FileTightenings, PlantError> {
    let mut recording = file.recording();
    recording.file = name;
    let prepared = preprocess(&recording, &study.preprocess, study.identify.fitted_output);
    let prepared = prepared.map_err(snug_study::StudyError::from)?;
    Ok(FileTightenings {
        tightenings: prepared.tightenings,
        findings: prepared.findings,
    })
}

/// One day: a file a tool, whose participant has the tool's number.
fn plan(simulation: &Simulation, effect: Option<HiddenEffect>) -> CampaignPlan {
    let file = |tool: usize| FilePlan {
        participant: tool as u32 + 1,
        strategy: Strategy::QuickStep,
        joint: if tool.is_multiple_of(2) {
            Joint::Soft
        } else {
            Joint::Hard
        },
        pace_per_min: 5,
        tightenings: simulation.per_day,
        channel_names: ChannelNames::Plain,
    };
    let plan = CampaignPlan {
        files: (0..simulation.tools).map(file).collect(),
        sample_rate_hz: simulation.sample_rate_hz,
        ..CampaignPlan::of_size(0, 0)
    };
    match effect {
        Some(effect) => plan
            .hiding(effect, simulation.strength)
            .of(Whose::Participants(simulation.in_tools.clone())),
        None => plan,
    }
}
