//! Real numbers, one or several side by side, whose every operation has the same bits on every processor.

use crate::numeric::arithmetic::Arithmetic;
use std::borrow::Cow;

/// Numbers that are computed with at once, lane by lane: one (`f64`), or one of every tightening that stands side by side
/// with others in a vector register.
///
/// No operation mixes lanes, none is fused and none depends on the processor, so that a tightening has the same bits
/// however many stand beside it.
pub trait Lanewise: Arithmetic + std::fmt::Debug {
    /// How many there are.
    const LANES: usize;
    /// The outcome of a comparison, lane by lane.
    type Mask: Copy;

    /// `value` in every lane of such a number.
    fn splat(self, value: f64) -> Self;
    /// `of(lane)` in every lane.
    fn lane_by_lane(self, of: impl FnMut(usize) -> f64) -> Self;
    /// The lanes' values.
    fn lanes(&self) -> &[f64];
    /// The lanes' values, to change them.
    fn lanes_mut(&mut self) -> &mut [f64];
    /// Signals, one for each lane, as one signal; a lane whose signal has ended keeps its last value.
    fn interleave<'a>(self, signals: &[&'a [f64]]) -> Cow<'a, [Self]>;

    /// self > other.
    fn is_above(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// √self.
    fn root(self) -> Self;
    /// Without its sign.
    fn magnitude(self) -> Self;
    /// 2 to the power of this whole number between −1022 and 1023.
    fn power_of_two(self) -> Self;

    /// Does `task` with the instructions that these numbers were made for.
    ///
    /// Only what is inlined into the task is compiled for them: everything that computes in it must be marked
    /// `#[inline(always)]`, closures included.
    fn vectorize<T: Task>(self, task: T) -> T::Output;

    /// self > 0.
    #[inline(always)]
    fn is_positive(self) -> Self::Mask {
        self.is_above(self.splat(0.0))
    }

    /// True in one lane only.
    #[inline(always)]
    fn only(self, lane: usize) -> Self::Mask {
        let marked = self.lane_by_lane(|other| f64::from(u8::from(other == lane)));
        marked.is_positive()
    }

    /// −1, 0 or 1.
    #[inline(always)]
    fn sign_of(self) -> Self {
        let zero = self.splat(0.0);
        let below = Self::choose(zero.is_above(self), self.splat(-1.0), zero);
        Self::choose(self.is_positive(), self.splat(1.0), below)
    }

    /// Not below `least`, not above `most`.
    #[inline(always)]
    fn within(self, least: f64, most: f64) -> Self {
        let (least, most) = (self.splat(least), self.splat(most));
        let low = Self::choose(least.is_above(self), least, self);
        Self::choose(low.is_above(most), most, low)
    }

    /// The nearest whole number; of sizes below 2^51.
    #[inline(always)]
    fn nearest(self) -> Self {
        (self + WHOLE) - WHOLE
    }

    /// A function that no hot loop needs, lane by lane.
    #[inline(always)]
    fn each(self, of: impl Fn(f64) -> f64) -> Self {
        self.lane_by_lane(
            #[inline(always)]
            |lane| only_when_asked(&of, self.lanes()[lane]),
        )
    }
}

/// The value of a function that is dear, for example a sine: inlined, it would be computed before the branch that asks.
#[inline(never)]
fn only_when_asked(of: &impl Fn(f64) -> f64, value: f64) -> f64 {
    of(value)
}

/// Work for [`Lanewise::vectorize`].
pub trait Task {
    /// What it gives.
    type Output;
    /// Does it.
    fn run(self) -> Self::Output;
}

/// 1.5 · 2^52: added to a number, it leaves no bits for a fraction, and the whole number in the lowest bits.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Bits of 2^whole, from those of whole + [`WHOLE`]: the exponent's field begins at bit 52 and is biased by 1023.
#[inline(always)]
pub(crate) fn exponent_bits(whole: u64) -> u64 {
    whole.wrapping_add(1023) << 52
}

impl Lanewise for f64 {
    const LANES: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn lane_by_lane(self, mut of: impl FnMut(usize) -> f64) -> Self {
        of(0)
    }
    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        std::slice::from_ref(self)
    }
    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        std::slice::from_mut(self)
    }
    #[inline(always)]
    fn interleave<'a>(self, signals: &[&'a [f64]]) -> Cow<'a, [Self]> {
        Cow::Borrowed(signals[0])
    }
    #[inline(always)]
    fn is_above(self, other: Self) -> bool {
        self > other
    }
    #[inline(always)]
    fn choose(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f64::from_bits(exponent_bits((self + WHOLE).to_bits()))
    }
    #[inline(always)]
    fn vectorize<T: Task>(self, task: T) -> T::Output {
        task.run()
    }
}
