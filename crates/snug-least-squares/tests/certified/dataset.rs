//! Reads a NIST StRD nonlinear file; its header says in which lines what stands.

use super::models::{model, response};
use super::regression::Regression;
use std::path::Path;

pub struct Dataset {
    pub name: String,
    pub starts: [Vec<f64>; 2],
    pub certified: Vec<f64>,
    pub standard_deviations: Vec<f64>,
    pub sum_of_squares: f64,
    pub regression: Regression,
}

/// The two line numbers (1-based, inclusive) in "… (lines 61 to 274)".
fn line_range(text: &str, label: &str) -> (usize, usize) {
    let line = text
        .lines()
        .find(|line| line.contains(label) && line.contains("(lines"));
    let numbers: Vec<usize> = (line.expect("the header names the lines").split("(lines"))
        .nth(1)
        .expect("just found")
        .split(|character: char| !character.is_ascii_digit())
        .filter_map(|word| word.parse().ok())
        .collect();
    (numbers[0], numbers[1])
}

fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect()
}

pub fn read(path: &Path) -> Dataset {
    let text = std::fs::read_to_string(path).expect("a listed file is readable");
    let lines: Vec<&str> = text.lines().collect();
    let name = path
        .file_stem()
        .expect("a file")
        .to_string_lossy()
        .into_owned();
    let (first, last) = line_range(&text, "Starting Values");
    let rows: Vec<Vec<f64>> = (lines[first - 1..last].iter())
        .map(|line| numbers(line.split('=').nth(1).expect("b1 = …")))
        .collect();
    let column = |index: usize| rows.iter().map(|row| row[index]).collect::<Vec<f64>>();
    let sum_of_squares = (lines.iter())
        .find(|line| line.contains("Residual Sum of Squares"))
        .and_then(|line| numbers(line).last().copied())
        .expect("certified sum of squares");
    let (first, last) = line_range(&text, "Data  ");
    let observations = (lines[first - 1..last].iter())
        .map(|line| numbers(line))
        .map(|row| (row[1..].to_vec(), response(&name, row[0])))
        .collect();
    Dataset {
        regression: Regression {
            model: model(&name).expect("one of the 27 sets"),
            parameter_count: rows.len(),
            observations,
        },
        starts: [column(0), column(1)],
        certified: column(2),
        standard_deviations: column(3),
        sum_of_squares,
        name,
    }
}
