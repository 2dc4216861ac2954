//! How fast Snug is, everything side by side in one run: `cargo xtask bench`.
#![allow(clippy::print_stdout, reason = "a benchmark prints its table")]

mod bare_lanes;
mod bare_loop;
mod base;
mod campaign;
mod effects;
mod improve;
mod measure;
mod peers;
mod ranking;
mod table;
mod throughput;

/// A section of the table: its name on the command line and what fills it; true asks for the long rows, too.
type Section = (&'static str, fn(bool));

/// In order of appearance.
const SECTIONS: &[Section] = &[
    ("base", base::fill),
    ("effects", effects::fill),
    ("ranking", ranking::fill),
    ("improve", improve::fill),
    ("throughput", throughput::fill),
    ("peers", peers::fill),
];

/// Shows the sections named on the command line, else all.
fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // Peak memory is that of a process of its own: this program, called again.
    if let [word, folder, out] = arguments.as_slice()
        && word == improve::CHILD
    {
        return improve::child(folder.as_ref(), out.as_ref());
    }
    let is_long = arguments.iter().any(|argument| argument == "--long");
    // Cargo adds `--bench` by itself.
    let named: Vec<&String> = (arguments.iter())
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    let known: Vec<&str> = SECTIONS.iter().map(|(name, _)| *name).collect();
    if let Some(unknown) = named.iter().find(|name| !known.contains(&name.as_str())) {
        let meant = snug_campaign::did_you_mean(unknown, &known);
        println!(
            "there is no section `{unknown}`{meant}; there are: {}",
            known.join(", ")
        );
        std::process::exit(2);
    }
    for (name, fill) in SECTIONS {
        if named.is_empty() || named.iter().any(|wanted| wanted == name) {
            fill(is_long);
        }
    }
}
