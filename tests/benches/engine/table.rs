//! The table: ratio first, then the times it comes from.

use crate::measure::Times;

/// What a ratio is taken against.
pub struct Reference<'a> {
    /// Its name, as in "1.9 × the bare loop".
    pub name: &'a str,
    /// Its times.
    pub times: &'a Times,
}

/// Heading of one section and of its columns.
pub fn section(title: &str) {
    println!("\n{title}");
    println!(
        "{:>34}  {:>32}  {:>32}  what",
        "ratio", "Snug: median (least – most)", "the reference"
    );
}

/// How many times longer than the reference we take.
pub fn times_the(reference: &Reference<'_>, ours: &Times, what: &str) {
    let ratio = ours.median_s() / reference.times.median_s();
    let ratio = format!("{} × {}", short(ratio), reference.name);
    row(&ratio, &shown(ours), &shown(reference.times), what);
}

/// How many times faster (or slower) than the reference we are.
pub fn faster_than(reference: &Reference<'_>, ours: &Times, what: &str) {
    let ratio = reference.times.median_s() / ours.median_s();
    let (ratio, word) = match ratio {
        slow if slow < 1.0 => (1.0 / slow, "slower"),
        fast => (fast, "faster"),
    };
    let ratio = format!("{} × {word} than {}", short(ratio), reference.name);
    row(&ratio, &shown(ours), &shown(reference.times), what);
}

/// A row without a reference.
pub fn alone(ours: &str, what: &str) {
    row("", ours, "", what);
}

/// What was left out, and why.
pub fn left_out(why: &str) {
    println!("{:>34}  {why}", "left out");
}

fn row(ratio: &str, ours: &str, reference: &str, what: &str) {
    println!("{ratio:>34}  {ours:>32}  {reference:>32}  {what}");
}

/// Median with least and most, in a unit that reads well.
pub fn shown(times: &Times) -> String {
    let median = times.median_s();
    let (factor, unit) = match median {
        s if s < 1e-3 => (1e6, "µs"),
        s if s < 1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    let value = short(median * factor);
    if times.rounds() == 1 {
        return format!("{value} {unit} (one run)");
    }
    let (least, most) = (
        short(times.least_s() * factor),
        short(times.most_s() * factor),
    );
    format!("{value} {unit} ({least} – {most})")
}

/// Three significant digits.
pub fn short(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        _ => 2,
    };
    format!("{value:.digits$}")
}
