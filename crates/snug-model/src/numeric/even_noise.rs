//! Repeatable noise for tests.

/// Independent values, evenly spread, with a variance of 1 (Knuth's congruential generator).
pub(crate) fn even_noise(count: usize) -> Vec<f64> {
    let mut state = 11_u64;
    let mut draw = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt()
    };
    (0..count).map(|_| draw()).collect()
}
