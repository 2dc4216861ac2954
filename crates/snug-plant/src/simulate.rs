//! A plant of simulated tools straight into a dataset, some of which an effect comes over on some day.

use crate::dataset::{Dataset, digest};
use crate::import::{Growing, Imported};
use crate::naming::Named;
use crate::partition::{Partition, date_of, days_since_1970};
use crate::{PlantError, Store};
use rayon::prelude::*;
use snug_preprocess::preprocess;
use snug_study::{FileTightenings, Study};
use snug_synthetic::{
    CampaignPlan, ChannelNames, FilePlan, HiddenEffect, Joint, Strategy, SyntheticFile, Whose,
    simulate,
};

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
        let plan = plan(
            simulation,
            effect.filter(|_| day + 1 >= simulation.from_day),
        );
        let seed = simulation
            .seed
            .wrapping_mul(1_000_003)
            .wrapping_add(day as u64);
        let campaign = simulate(&plan, seed)?;
        let date = date_of(first + day as i32);
        let named: Vec<Named> = (1..=simulation.tools)
            .map(|tool| {
                Ok(Named {
                    partition: Partition::new(&date, &format!("T{tool:04}"))?,
                    station: Some(format!("S{:02}", (tool - 1) / 4 + 1)),
                    time_of_day_s: Some(6.0 * 3600.0),
                })
            })
            .collect::<Result<_, PlantError>>()?;
        let read: Vec<_> = (campaign.files.par_iter().zip(named))
            .map(|(file, named)| {
                let source = digest(format!("{seed} {plan:?} {}", named.partition).as_bytes());
                Ok((source, file_tightenings(&study, file, &named)?, named))
            })
            .collect::<Result<_, PlantError>>()?;
        for (source, file, named) in read {
            let partition = named.partition.clone();
            let before = dataset.commit_of(&partition).await?.unwrap_or_default();
            let mut growing = Growing::new(&dataset, partition, before);
            growing
                .take(vec![(source, named, file)], &mut imported)
                .await?;
            growing.finish(&mut imported).await?;
        }
    }
    Ok(imported)
}

fn file_tightenings(
    study: &Study,
    file: &SyntheticFile,
    named: &Named,
) -> Result<FileTightenings, PlantError> {
    let mut recording = file.recording();
    recording.file = format!("{}_{}.mat", named.partition.tool, named.partition.day);
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
