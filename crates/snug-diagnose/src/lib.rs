#![allow(dead_code)]
//! Where a model fails, which physical effect is missing, and how sure that is.

mod case;
mod dense;
mod error;
mod family;
mod fitted;
mod hypothesis;
mod locate;
mod ranking;
mod score;
mod settings;
mod units;

pub use case::Case;
pub use error::DiagnoseError;
pub use locate::{Seen, compare, drifts, locate};
pub use settings::DiagnoseSettings;

#[allow(missing_docs,clippy::print_stdout,dead_code)]
pub fn scratch(cases: &[Case]) -> Result<(), DiagnoseError> {
    let units = units::Units::of(cases);
    let settings = DiagnoseSettings::default();
    let t = std::time::Instant::now();
    let mut current = ranking::fit_effects(cases, &[], None, units)?;
    println!("base {:.5} {:?} lin {}", current.error(), t.elapsed(), current.linearizations);
    for _ in 0..std::env::var("RUNGS").map_or(2, |r| r.parse().unwrap_or(2)) {
        let all: Vec<_> = snug_model::Effect::ALL.iter().copied().filter(|e| !current.effects.contains(e) && e.name() != "output_offset").collect();
        let ranking = ranking::rank(cases, &current, &all, units, &settings)?;
        println!("rank {:?} misfit {:.0}", t.elapsed(), current.squares() - current.count() as f64);
        for c in ranking.candidates.iter().take(9) {
            println!("{:28} T {:6.2} p {:.4} gain {:10.1} ± {:7.1} err {:.4} conv {} lin {} {:?}", c.effect.name(), c.score, c.p_family, c.gain(), c.gain_error(), c.fitted.error(), c.fitted.converged, c.fitted.linearizations, c.fitted.shared_named());
        }
        let best = &ranking.candidates[0];
        if best.gain() < 5e-3 * current.squares() { break; }
        current = best.fitted.clone();
    }
    Ok(())
}
