//! A study's tightenings, read, prepared and settled once, for models to be tried on them by hand.

use crate::error::StudyError;
use crate::evaluation::tightening::is_usable;
use crate::run::campaign_result::vocabulary;
use crate::study::Study;
use crate::tasks::cases::{FilesRead, chosen, with_settled};
use crate::tasks::own_effects::effects;
use crate::tasks::settling::{Settled, settle};
use snug_campaign::SignalUnits;
use snug_campaign::words::capitalised;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_diagnose::{DiagnoseError, Goal, LiveCases, LiveFit, Question};
use snug_files::Host;
use snug_model::Effect;

/// A study's tightenings, ready for models to be tried on them.
pub struct Prepared {
    /// The study, with the choices made that it left open.
    pub study: Study,
    /// The tightenings from which effects are learnt, as `diagnose` takes them.
    pub live: LiveCases,
    /// Effects of the study's own model.
    pub effects: Vec<Effect>,
    /// Measurement files that the data hold.
    pub files: usize,
    /// Units in which signals are shown.
    pub units: SignalUnits,
    /// In whose words results are told.
    pub vocabulary: Vocabulary,
    /// What is to be said of tightenings that take no part, and of choices that were made; a sentence each.
    pub remarks: Vec<String>,
}

/// Reads and prepares a study's tightenings as `diagnose` does; `tell` hears of each file that was read. Nothing is written.
///
/// # Errors
/// As [`crate::run()`] for settings and data, and where no tightening can be compared with the model.
pub fn prepare(study: &Study, tell: &(dyn Fn(FilesRead) + Sync)) -> Result<Prepared, StudyError> {
    study.check()?;
    let listing = snug_ingest::list_on(&Host, &study.source, &study.source.path)?;
    let files = study.validation.last(listing.files)?;
    let most = study.diagnosis.most_tightenings;
    let (comparable, _) = chosen(study, &Host, &files, most, tell)?;
    if comparable.cases.is_empty() {
        let known: Vec<String> = (comparable.reasons.iter().map(ToString::to_string))
            .chain(
                study
                    .what_counts()
                    .map(|counts| format!("{}.", capitalised(&counts))),
            )
            .collect();
        let reason = match known.is_empty() {
            true => {
                "each is faulty or kept for validation; `run` on the same data says which".into()
            }
            false => known.join(" "),
        };
        return Err(DiagnoseError::NothingToCompare { reason }.into());
    }
    let cases = comparable.cases;
    let (study, cases, reasons) = match settle(study, &cases) {
        Some(Settled { study, reasons, .. }) => {
            let cases = with_settled(&study, cases)?;
            (study, cases, reasons)
        }
        None => (study.clone(), cases, Vec::new()),
    };
    let own = effects(&study, &study.model.effects, &cases)?;
    let units = study.source.units(study.preprocess.rig.lever_arm_m);
    let question = Question {
        cases: &[],
        effects: own.clone(),
        by_group: study.sizes_by_group(),
        custom: study.model.custom_effects()?,
        goal: Goal::Compare,
        may_ask_for_steps: false,
        until: None,
        units: units.clone(),
    };
    let mut search = study.diagnosis.search.clone();
    search.seed = search.seed.wrapping_add(study.seed);
    let remarks = reasons.iter().chain(&comparable.reasons);
    Ok(Prepared {
        remarks: remarks.map(ToString::to_string).collect(),
        live: LiveCases::new(&question, cases, search)?,
        effects: own,
        files: files.len(),
        vocabulary: vocabulary(&study, &units),
        units,
        study,
    })
}

impl Prepared {
    /// The named effects, from the catalogue or the study's own, as they act on its rig.
    ///
    /// # Errors
    /// [`StudyError::Model`] names the one that is not known.
    pub fn named(&self, names: &[String]) -> Result<Vec<Effect>, StudyError> {
        effects(&self.study, names, self.live.tasks())
    }

    /// How many of the tightenings would be selected under `fit`, as the study selects them.
    ///
    /// # Errors
    /// [`StudyError::Diagnose`] for what the fit of a tightening refuses, [`StudyError::Model`] for what its simulation does.
    pub fn usable(&self, fit: &LiveFit) -> Result<usize, StudyError> {
        let estimates = self.live.estimates(fit)?;
        let mut usable = 0;
        for (task, (model, estimate)) in self.live.tasks().iter().zip(&estimates) {
            usable += usize::from(is_usable(&self.study, task, model, estimate)?);
        }
        Ok(usable)
    }
}
