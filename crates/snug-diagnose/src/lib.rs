#![allow(dead_code)]
//! Where a model fails, which physical effect is missing, and how sure that is.

mod case;
mod climb;
mod dense;
mod detectability;
mod error;
mod evidence;
mod examine;
mod experiment;
mod family;
mod fitted;
mod hypothesis;
mod locate;
mod ranking;
mod score;
mod settings;
mod sizes;
mod torque_noise;
mod units;
mod unlisted;
mod wording;

pub use case::Case;
pub use error::DiagnoseError;
pub use examine::{Answer, Goal, Question, RungModel, examine};
pub use locate::{Seen, compare, drifts, locate};
pub use settings::DiagnoseSettings;

#[allow(missing_docs,clippy::print_stdout,dead_code)]
pub fn scratch(cases: &[Case]) -> Result<(), DiagnoseError> {
    let units = units::Units::of(cases);
    let settings = DiagnoseSettings::default();
    let t = std::time::Instant::now();
    let climb = climb::climb(cases, &[], &[], units, &settings, &|text| println!("{text}"))?;
    println!("time {:?} stop {:?}", t.elapsed(), climb.stopped);
    for (i, r) in climb.rungs.iter().enumerate() {
        println!("  rung {:?} err {:.4} {:?}", r.effects.iter().map(|e| e.name()).collect::<Vec<_>>(), r.error(), r.shared_named());
        if i > 0 { let a = &climb.additions[i-1]; println!("     p {:.4} gain {:.3} twins {:?}", a.p_family, a.heldout_gain, a.twins.iter().map(|e| e.name()).collect::<Vec<_>>()); }
    }
    println!("control {:?}", climb.ranking.control);
    for c in climb.ranking.candidates.iter().take(4) {
        println!("{:28} T {:6.2} p {:.4} gain {:10.1} ± {:7.1} err {:.4} conv {} lin {} {:?}", c.effect.name(), c.score, c.p_family, c.gain(), c.gain_error(), c.fitted.error(), c.fitted.converged, c.fitted.linearizations, c.fitted.shared_named());
    }
    Ok(())
}
