use std::fmt;
use std::time::Instant;

/// Runs of each row; the table shows their median.
const RUNS: usize = 9;

/// Rows of name and time per fit, and their ratio to the yardstick.
pub struct Table {
    filter: Option<String>,
    rows: Vec<(String, f64)>,
    yardstick_s: f64,
}

impl Table {
    /// Only rows whose name contains `filter` are measured; the first row always is.
    pub fn new(filter: Option<String>) -> Self {
        Self {
            filter,
            rows: Vec::new(),
            yardstick_s: f64::NAN,
        }
    }

    /// Times `work`, which does `count` fits; gives the median seconds of one.
    pub fn measure(&mut self, name: &str, count: usize, mut work: impl FnMut()) -> f64 {
        let wanted = self
            .filter
            .as_ref()
            .is_none_or(|part| name.contains(part.as_str()));
        if !wanted && !self.rows.is_empty() {
            return f64::NAN;
        }
        work();
        let mut times: Vec<f64> = (0..RUNS)
            .map(|_| {
                let start = Instant::now();
                work();
                start.elapsed().as_secs_f64() / count as f64
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let median = times[RUNS / 2];
        self.rows.push((name.to_owned(), median));
        median
    }

    /// What ratios refer to.
    pub fn yardstick(&mut self, seconds: f64) {
        self.yardstick_s = seconds;
    }
}

impl fmt::Display for Table {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            formatter,
            "{:>8}  {:>12}  one fit, 3000 samples, one core",
            "ratio", "ms"
        )?;
        for (name, seconds) in &self.rows {
            writeln!(
                formatter,
                "{:>8.2}  {:>12.4}  {name}",
                seconds / self.yardstick_s,
                1e3 * seconds
            )?;
        }
        Ok(())
    }
}
