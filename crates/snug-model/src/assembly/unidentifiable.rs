//! Errors of the rig's numbers that m, c and k absorb, so that no fit can tell them: named, never ranked.

/// An error of the rig's numbers that no recording can show, because m, c and k absorb it exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Invisible {
    /// Fixed name in snake case.
    pub name: &'static str,
    /// One sentence in plain words.
    pub summary: &'static str,
    /// What it does to the equations.
    pub equation: &'static str,
    /// Why it cannot be seen, and what it does instead.
    pub reason: &'static str,
    /// What to check at the bench.
    pub check: &'static str,
}

/// What Snug never ranks, since no fit could be better or worse for it.
pub const INVISIBLE: &[Invisible] = &[
    Invisible {
        name: "torque_gain",
        summary: "The torque sensor reads too much or too little by a constant factor.",
        equation: "(1 + g) T",
        reason: "c, k and the whole inertia I_n + m l^2 come out wrong by the same factor, and the motion stays the same. The fit is as good as ever, but m, c and k are wrong.",
        check: "Calibrate the torque sensor against a known one.",
    },
    Invisible {
        name: "lever_arm_error",
        summary: "The hand holds the tool nearer or further out than the study says.",
        equation: "l (1 + e)",
        reason: "Only m l^2, c l^2 and k l^2 act on the tool: with another l they come out larger or smaller by its square, and the motion stays the same. The fit is as good as ever, but m, c and k are wrong.",
        check: "Measure the distance from the joint's axis to the middle of the hand.",
    },
];
