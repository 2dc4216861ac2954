//! Stories that cross crates: one module per story.
#![allow(clippy::unwrap_used, reason = "a failing story should say where")]
#![allow(clippy::print_stdout, reason = "a skipped or measured check says so")]

mod any_units;
mod bad_input;
mod blind;
mod campaign;
mod coarse;
mod faults;
mod gap;
mod interruption;
mod intervals;
mod layers;
mod made_up_rigs;
mod many;
mod motor;
mod mystery;
mod one_pass;
mod other_rigs;
mod people;
mod people_sealed;
mod people_tools;
mod practice;
mod recording;
mod round_trip;
mod thesis_preset;
mod threads;
mod unknown_rigs;
mod validation;
mod work;
