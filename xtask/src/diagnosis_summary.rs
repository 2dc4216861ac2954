//! What a diagnosis came to, on one screen: the verdict, the ladder as a picture, the ranking, what to do next.

mod ladder;
mod ranking;
mod size;
#[cfg(test)]
mod tests;

use ladder::ladder;
use ranking::ranking;
use size::{by_chance, significant, sized};
use snug_campaign::{Diagnosis, Location, RankedEffect, Verdict};
use std::fmt::Write as _;
use std::io::IsTerminal as _;

/// Columns that a line may have.
const WIDTH: usize = 108;
/// What the proposed commands need to know.
pub struct Following<'a> {
    /// The options of the command that was run (`--data DIR`), to be repeated.
    pub options: &'a str,
    /// The study file that holds the model found.
    pub study: &'a str,
    /// The one among the results, which always holds it.
    pub written: &'a str,
}

/// A diagnosis as it is printed on standard output.
pub fn of(diagnosis: &Diagnosis, following: &Following<'_>) -> String {
    text(diagnosis, following, std::io::stdout().is_terminal())
}

/// The text; `terminal` allows block characters and bold type.
fn text(diagnosis: &Diagnosis, following: &Following<'_>, terminal: bool) -> String {
    let mut page = Page {
        text: String::new(),
        terminal,
    };
    verdict(&mut page, diagnosis);
    missing(&mut page, diagnosis);
    ladder(&mut page, diagnosis);
    added(&mut page, diagnosis);
    ranking(&mut page, diagnosis);
    places(&mut page, diagnosis);
    certainty(&mut page, diagnosis);
    next(&mut page, diagnosis, following);
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
        _ if diagnosis.interrupted => "stopped by you before there was one",
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

/// What the effect is that the verdict names, how it shows and what to check, while it is not yet in the model; the same of
/// its twins.
fn missing(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(first) = not_yet_added(diagnosis) else {
        return;
    };
    let is_twin = |one: &&RankedEffect| first.twins.contains(&one.effect);
    let twins = diagnosis.ranking.iter().filter(is_twin);
    for one in std::iter::once(first).chain(twins) {
        let name = called(&one.effect, one.expression.as_ref());
        page.heading(&format!("What {} is", name.replace('_', " ")));
        for sentence in &one.explanation {
            page.paragraph("  - ", sentence);
        }
    }
}

/// The effect or law that the verdict names, while it is not yet in the model.
fn not_yet_added(diagnosis: &Diagnosis) -> Option<&RankedEffect> {
    match diagnosis.verdict {
        Verdict::MissingEffect => diagnosis.ranking.first(),
        Verdict::UnlistedEffect => {
            let law = diagnosis.unlisted.as_ref()?;
            let is_it = |one: &&RankedEffect| one.expression.as_ref() == Some(&law.expression);
            diagnosis.ranking.iter().find(is_it)
        }
        Verdict::Adequate | Verdict::Undecided => None,
    }
}

/// `cubic_stiffness`; a term in no catalogue by what it is: `force p*x^2*v`.
fn called(effect: &str, expression: Option<&String>) -> String {
    expression.map_or_else(
        || effect.to_owned(),
        |expression| format!("force {expression}"),
    )
}

/// An effect of the model by its name, a term in no catalogue by what it is.
fn called_in(diagnosis: &Diagnosis, effect: &str) -> String {
    called(effect, diagnosis.expression(effect))
}

/// Effects that a diagnosis knows as a sentence lists them.
fn names_in(diagnosis: &Diagnosis, effects: &[String]) -> String {
    let names = effects.iter().map(|effect| called_in(diagnosis, effect));
    names.collect::<Vec<_>>().join(", ")
}

fn shortened(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    let kept: String = text.chars().take(columns - 1).collect();
    kept + "…"
}

fn added(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.added.is_empty() {
        return;
    }
    page.heading("In the model now");
    for effect in &diagnosis.added {
        let sizes: Vec<String> = effect.parameters.iter().map(sized).collect();
        let name = called(&effect.effect, effect.expression.as_ref());
        page.paragraph("  ", &format!("{name}: {}", sizes.join("; ")));
        let mut evidence = Vec::new();
        if let Some(gain) = effect.heldout_gain {
            evidence.push(format!(
                "removes {:.0} % of the misfit in unseen tightenings",
                100.0 * gain.clamp(0.0, 1.0)
            ));
        }
        if let Some(p) = effect.p_family {
            evidence.push(by_chance(p));
        }
        if !effect.twins.is_empty() {
            evidence.push(format!(
                "these data cannot tell it from {}",
                names_in(diagnosis, &effect.twins)
            ));
        }
        if !evidence.is_empty() {
            page.paragraph("    - ", &evidence.join("; "));
        }
        for sentence in &effect.explanation {
            page.paragraph("    - ", sentence);
        }
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
    let rate = control.false_alarms as f64 / control.campaigns.max(1) as f64;
    page.paragraph(
        "  ",
        &format!(
            "{} campaigns were simulated in which nothing is missing. In {} of them, {:.0} in 100, an effect was called \
             missing all the same; meant are {:.0} in 100 (95 % interval {:.0} to {:.0} in 100).",
            control.campaigns,
            control.false_alarms,
            100.0 * rate,
            100.0 * control.nominal_rate,
            100.0 * control.rate_low,
            100.0 * control.rate_high
        ),
    );
}

fn next(page: &mut Page, diagnosis: &Diagnosis, following: &Following<'_>) {
    page.heading("What to do next");
    let command = |page: &mut Page, words: &str| {
        page.line(format!("    cargo xtask {words} {}", following.options).trim_end());
    };
    if let Some(experiment) = &diagnosis.experiment {
        page.paragraph("  ", &experiment.statement);
    }
    if diagnosis.interrupted {
        page.paragraph("  ", "Go on from the model found so far:");
        page.line(&format!(
            "    cargo xtask improve --study {}",
            following.written
        ));
        return;
    }
    if diagnosis.verb == "compare" {
        page.paragraph("  ", "Ask which effect is missing; it changes nothing:");
        return command(page, "diagnose");
    }
    let climbed = matches!(diagnosis.verb.as_str(), "add" | "improve");
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
                    page.paragraph("  ", "To keep it as a law of your own, paste this into the study's model.custom list:");
                    page.line(&format!("    {}", term.ron));
                }
                None => page.paragraph("  ", "The report draws the missing force over time, displacement and velocity."),
            }
            if !climbed {
                page.paragraph("  ", "Or let Snug add it and see the error before and after:");
                command(page, "improve");
            }
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
    if climbed && !diagnosis.added.is_empty() {
        page.paragraph("  ", "Use the model found for this and further recordings:");
        page.line(&format!("    cargo xtask run --study {}", following.study));
    }
}
