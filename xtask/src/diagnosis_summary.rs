//! What a diagnosis came to, on one screen: the verdict, the ladder as a picture, the ranking, what to do next.

mod size;
#[cfg(test)]
mod tests;

use size::{by_chance, significant, sized};
use snug_campaign::{Diagnosis, Location, RankedEffect, Rung, Verdict};
use std::fmt::Write as _;
use std::io::IsTerminal as _;

/// Columns that a line may have.
const WIDTH: usize = 108;
/// Columns of the longest bar.
const BAR: usize = 36;
/// Candidates shown; the report lists all. Behind the very first, neither twins nor unlisted terms nor what could be chance.
const CANDIDATES: usize = 8;
const FIRST: usize = 3;

/// Prints a diagnosis on standard output.
///
/// `options` are those of the command that was run (`--study rig.ron`), repeated in the command that it proposes next.
pub fn print(diagnosis: &Diagnosis, options: &str) {
    print!(
        "{}",
        text(diagnosis, options, std::io::stdout().is_terminal())
    );
}

/// The text; `terminal` allows block characters and bold type.
fn text(diagnosis: &Diagnosis, options: &str, terminal: bool) -> String {
    let mut page = Page {
        text: String::new(),
        terminal,
    };
    verdict(&mut page, diagnosis);
    ladder(&mut page, diagnosis);
    added(&mut page, diagnosis);
    ranking(&mut page, diagnosis);
    places(&mut page, diagnosis);
    certainty(&mut page, diagnosis);
    next(&mut page, diagnosis, options);
    page.text
}

struct Page {
    text: String,
    terminal: bool,
}

impl Page {
    fn line(&mut self, line: &str) {
        let line = line.replace('\u{a0}', " ");
        writeln!(self.text, "{}", line.trim_end()).expect("a string takes every write");
    }

    fn heading(&mut self, heading: &str) {
        if self.terminal {
            self.line(&format!("\n\u{1b}[1m{heading}\u{1b}[0m"));
        } else {
            self.line(&format!("\n{heading}"));
        }
    }

    /// A paragraph behind `lead`, its further lines below its first.
    fn paragraph(&mut self, lead: &str, words: &str) {
        let indent = " ".repeat(lead.chars().count());
        let mut line = lead.to_owned();
        // A number and its percent sign stay on one line.
        let words = words.replace(" %", "\u{a0}%");
        for word in words.split([' ', '\n']).filter(|word| !word.is_empty()) {
            let used = line.chars().count();
            if used > indent.len() && used + 1 + word.chars().count() > WIDTH {
                self.line(&line);
                line.clone_from(&indent);
            }
            if line.chars().count() > indent.len() {
                line.push(' ');
            }
            line += word;
        }
        self.line(&line);
    }
}

fn verdict(page: &mut Page, diagnosis: &Diagnosis) {
    let known = diagnosis
        .ladder
        .iter()
        .any(|rung| rung.error_over_noise.is_some());
    let word = match diagnosis.verdict {
        Verdict::Adequate => "the model is adequate",
        Verdict::MissingEffect => "an effect is missing",
        Verdict::UnlistedEffect => "something is missing that is in no catalogue",
        // A comparison asks how much is missing, not what.
        Verdict::Undecided if diagnosis.verb == "compare" && known => {
            "the model leaves more than the noise"
        }
        Verdict::Undecided if diagnosis.verb == "compare" => {
            "the model leaves an error, and the noise is not known"
        }
        Verdict::Undecided => "too little data to say",
    };
    page.heading(&format!("Verdict: {word}"));
    page.paragraph("  ", &diagnosis.headline);
    for reason in &diagnosis.reasons {
        page.paragraph("  - ", reason);
    }
    let told = |name: &str| {
        let words = name.replace('_', " ");
        diagnosis
            .reasons
            .iter()
            .any(|reason| reason.contains(&words) && reason.contains("taken out"))
    };
    for corrected in diagnosis
        .corrected
        .iter()
        .filter(|corrected| !told(&corrected.effect))
    {
        page.paragraph(
            "  - ",
            &format!(
                "Taken out before the fit: {}, typically {} {}, in {:.0} % of the tightenings.",
                corrected.effect,
                significant(corrected.size),
                corrected.unit,
                100.0 * corrected.share
            ),
        );
    }
}

fn ladder(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(first) = diagnosis.ladder.first() else {
        return;
    };
    let known = diagnosis
        .ladder
        .iter()
        .any(|rung| rung.error_over_noise.is_some());
    if known {
        page.heading("How far the model misses the measurement, as a multiple of the noise (1.0 = nothing left but noise)");
    } else {
        page.heading(&format!(
            "How far the model misses the measurement: residual of the {}, root mean square (the noise is unknown)",
            diagnosis.compared_output
        ));
    }
    let unseen = if known { "unseen" } else { "" };
    page.line(&format!(
        "  {:<32} {:>9} {unseen:>9} {:>9}",
        "model", "error", "selected"
    ));
    let errors: Vec<Option<f64>> = diagnosis
        .ladder
        .iter()
        .map(|rung| {
            if known {
                rung.error_over_noise
            } else {
                Some(rung.rms_fitted_output)
            }
        })
        .collect();
    let floor = if known { 1.0 } else { 0.0 };
    let mut before: &Rung = first;
    for (rung, error) in diagnosis.ladder.iter().zip(&errors) {
        let number = |value: Option<f64>| value.map_or_else(|| "?".to_owned(), significant);
        let unseen = if known {
            number(rung.heldout_error_over_noise)
        } else {
            String::new()
        };
        let line = format!(
            "  {:<32} {:>9} {unseen:>9} {:>7.0} %  {}",
            shortened(&step(before, rung), 32),
            number(*error),
            100.0 * rung.selected_fraction,
            bar(*error, &errors, floor, page.terminal)
        );
        page.line(&line);
        before = rung;
    }
    if known {
        page.line("  Bars begin at the noise and are logarithmic; unseen: in tightenings that the sizes were not fitted to.");
    }
    if let Some(stopped) = &diagnosis.stopped {
        page.paragraph("  Stopped: ", stopped);
    }
    for removal in &diagnosis.removals {
        page.paragraph("  Tried without: ", &removal.statement);
    }
}

/// What a rung changes against the one before it.
fn step(before: &Rung, rung: &Rung) -> String {
    let gained = rung.effects.iter().filter(|e| !before.effects.contains(e));
    let lost = before.effects.iter().filter(|e| !rung.effects.contains(e));
    let steps: Vec<String> = gained
        .map(|effect| format!("+ {effect}"))
        .chain(lost.map(|effect| format!("- {effect}")))
        .collect();
    match (steps.is_empty(), rung.effects.is_empty()) {
        (true, true) => "base model: mass, damper, spring".into(),
        (true, false) => format!("base + {}", rung.effects.join(" + ")),
        (false, _) => steps.join(" "),
    }
}

fn shortened(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    let kept: String = text.chars().take(columns - 1).collect();
    kept + "…"
}

/// A bar from the floor to the error: over noise logarithmic, else straight.
fn bar(error: Option<f64>, errors: &[Option<f64>], floor: f64, terminal: bool) -> String {
    let length = |error: f64| {
        if floor > 0.0 {
            (error / floor).ln().max(0.0)
        } else {
            error
        }
    };
    let longest = errors
        .iter()
        .flatten()
        .map(|error| length(*error))
        .fold(0.0, f64::max);
    let share = match error {
        Some(error) if longest > 0.0 => length(error) / longest.max(0.05),
        _ => 0.0,
    };
    if !share.is_finite() {
        return "|".into();
    }
    let blocks = (share * BAR as f64).round() as usize;
    format!("|{}", if terminal { "█" } else { "#" }.repeat(blocks))
}

fn added(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.added.is_empty() {
        return;
    }
    page.heading("In the model now");
    for effect in &diagnosis.added {
        let sizes: Vec<String> = effect.parameters.iter().map(sized).collect();
        page.paragraph("  ", &format!("{}: {}", effect.effect, sizes.join("; ")));
        let mut evidence = Vec::new();
        if let Some(gain) = effect.heldout_gain {
            evidence.push(format!(
                "removes {:.0} % of the misfit in unseen tightenings",
                100.0 * gain
            ));
        }
        if let Some(p) = effect.p_family {
            evidence.push(by_chance(p));
        }
        if !effect.twins.is_empty() {
            evidence.push(format!(
                "these data cannot tell it from {}",
                effect.twins.join(", ")
            ));
        }
        if !evidence.is_empty() {
            page.paragraph("    ", &evidence.join("; "));
        }
    }
}

fn ranking(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.ranking.is_empty() {
        return;
    }
    let candidates: Vec<(usize, &RankedEffect)> = diagnosis
        .ranking
        .iter()
        .enumerate()
        .filter(|(place, candidate)| {
            *place < FIRST || !candidate.unlisted && candidate.p_family <= 0.05
        })
        .take(CANDIDATES)
        .collect();
    let shown = candidates.len();
    page.heading(&format!(
        "What could {}be missing: the best {shown} of {} candidates",
        if diagnosis.added.is_empty() {
            ""
        } else {
            "still "
        },
        diagnosis.ranking.len()
    ));
    if diagnosis.verdict == Verdict::Adequate {
        page.paragraph(
            "  ",
            "What the model leaves is within the noise: shares of next to nothing say little.",
        );
    }
    page.line(&format!(
        "  {:<27} {:>12} {:>8}  {}",
        "effect", "removes", "chance", "size [95 % interval]"
    ));
    for (place, candidate) in candidates {
        row(page, candidate, place < FIRST);
    }
    let unlisted = diagnosis
        .ranking
        .iter()
        .filter(|candidate| candidate.unlisted)
        .count();
    if unlisted > 0 {
        page.paragraph(
            "  ",
            &format!("{unlisted} of the candidates are simple terms that are in no catalogue; report.html has them all."),
        );
    }
    page.paragraph(
        "  ",
        "removes: share of the misfit it takes away in tightenings its size was not fitted to; \
         chance: how often chance alone would put something so strong at the top.",
    );
}

fn row(page: &mut Page, candidate: &RankedEffect, with_twins: bool) {
    let name = if candidate.unlisted {
        format!("{} (unlisted)", candidate.effect)
    } else {
        candidate.effect.clone()
    };
    let gain = size::share(candidate.heldout_gain, candidate.heldout_gain_error);
    let lead = format!(
        "  {:<27} {gain:>12} {:>8}  ",
        shortened(&name, 27),
        size::p_value(candidate.p_family)
    );
    let mut sizes: Vec<String> = candidate.parameters.iter().map(sized).collect();
    if !candidate.plausible {
        sizes.push("not plausible: on the edge of its range".into());
    }
    page.paragraph(&lead, &sizes.join("; "));
    if with_twins && !candidate.twins.is_empty() {
        page.paragraph("      cannot be told from ", &candidate.twins.join(", "));
    }
}

fn places(page: &mut Page, diagnosis: &Diagnosis) {
    let remarks = |page: &mut Page, heading: &str, location: &Location| {
        if location.remarks.is_empty() {
            return;
        }
        page.heading(heading);
        for remark in &location.remarks {
            page.paragraph("  - ", remark);
        }
    };
    match &diagnosis.final_location {
        Some(last) => {
            remarks(
                page,
                "Where the study's own model failed",
                &diagnosis.location,
            );
            remarks(page, "Where the model fails now", last);
        }
        None => remarks(page, "Where the model fails", &diagnosis.location),
    }
}

fn certainty(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(control) = &diagnosis.control else {
        return;
    };
    page.heading("How far to trust this");
    page.paragraph(
        "  ",
        &format!(
            "On {} campaigns simulated without a missing effect, the ranking raised {} false alarm{} \
             (meant: {:.0} in 100; 95 % interval of the rate reached {:.0} to {:.0} in 100).",
            control.campaigns,
            control.false_alarms,
            if control.false_alarms == 1 { "" } else { "s" },
            100.0 * control.nominal_rate,
            100.0 * control.rate_low,
            100.0 * control.rate_high
        ),
    );
}

fn next(page: &mut Page, diagnosis: &Diagnosis, options: &str) {
    page.heading("What to do next");
    let command = |page: &mut Page, words: &str| {
        page.line(format!("    cargo xtask {words} {options}").trim_end());
    };
    if let Some(experiment) = &diagnosis.experiment {
        page.paragraph("  ", &experiment.statement);
    }
    if diagnosis.verb == "compare" {
        page.paragraph("  ", "Ask which effect is missing; it changes nothing:");
        return command(page, "diagnose");
    }
    match diagnosis.verdict {
        Verdict::MissingEffect => {
            if let Some(best) = diagnosis.ranking.first() {
                page.paragraph("  ", "Add it and see the error before and after:");
                command(page, &format!("add {}", best.effect));
            }
            page.paragraph("  ", "Or let Snug add what is justified, one after another:");
            command(page, "improve");
        }
        Verdict::UnlistedEffect => {
            match &diagnosis.unlisted {
                Some(term) => {
                    page.paragraph("  ", &term.statement);
                    page.paragraph("  ", "To try it, paste this into the study's model.custom list and diagnose again:");
                    page.line(&format!("    {}", term.ron));
                }
                None => page.paragraph("  ", "The report draws the missing force over time, displacement and velocity."),
            }
            command(page, "diagnose");
        }
        Verdict::Undecided if diagnosis.experiment.is_none() => {
            page.paragraph("  ", "Record more tightenings; the reasons above say what is lacking.");
        }
        Verdict::Undecided => {}
        Verdict::Adequate => page.paragraph(
            "  ",
            "Nothing needs to be added. report.html shows what was checked and how small a missing effect would have been seen.",
        ),
    }
}
