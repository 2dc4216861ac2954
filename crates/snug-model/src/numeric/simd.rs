//! Real numbers side by side in the vector registers of the processor at hand, found out at run time.
//!
//! What is computed for eight tightenings, each in its own lane, costs little more than for one. The `pulp` crate knows the
//! registers; here its operations become a [`Real`].

use crate::numeric::lanewise::{Lanewise, Task, WHOLE, exponent_bits};
use crate::numeric::number::{Number, OfOne, Real};
use pulp::bytemuck::{Zeroable, cast_slice, cast_slice_mut};
use pulp::{Arch, Simd, WithSimd};
use std::borrow::Cow;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Work that can be done with any kind of real numbers.
pub trait LaneTask {
    /// What it gives.
    type Output;
    /// Does it with numbers of `zero`'s kind.
    fn run<R: Real>(self, zero: R) -> Self::Output;
}

/// Does `task` with as many numbers side by side as the processor has room for: 8 with AVX-512, 4 with AVX2, 2 on
/// ARM, else 1.
///
/// The task itself is compiled for every processor; what is hot in it goes through [`Lanewise::vectorize`].
pub fn in_lanes<T: LaneTask>(task: T) -> T::Output {
    match Arch::new() {
        #[cfg(target_arch = "x86_64")]
        Arch::V4(simd) => task.run(Lanes::<_, Bytes64>::new(simd, 0.0)),
        #[cfg(target_arch = "x86_64")]
        Arch::V3(simd) => task.run(Lanes::<_, Bytes32>::new(simd, 0.0)),
        #[cfg(target_arch = "aarch64")]
        Arch::Neon(simd) => task.run(Lanes::<_, Bytes16>::new(simd, 0.0)),
        _ => task.run(0.0),
    }
}

/// Does `work` compiled for the processor at hand, whose wide registers loops over slices then use by themselves.
///
/// What computes in it must be marked `#[inline(always)]`, closures included.
pub fn with_processor_instructions<T>(work: impl FnOnce() -> T) -> T {
    Arch::new().dispatch(work)
}

/// One vector register; `S` stands for the proof that the processor has it, `A` for where it may lie in memory: across
/// two lines of the cache, reading and writing it would take twice as long.
#[derive(Debug, Clone, Copy)]
pub struct Lanes<S: Simd, A: Alignment> {
    simd: S,
    register: S::f64s,
    _aligned: [A; 0],
}

/// What begins at a multiple of a number of bytes.
pub trait Alignment: Copy + std::fmt::Debug {}

/// Declares such a beginning, for the registers of one kind of processor.
macro_rules! alignment {
    ($architecture:literal, $Bytes:ident, $bytes:literal) => {
        #[cfg(target_arch = $architecture)]
        #[derive(Debug, Clone, Copy)]
        #[repr(align($bytes))]
        pub struct $Bytes;

        #[cfg(target_arch = $architecture)]
        impl Alignment for $Bytes {}
    };
}

alignment!("x86_64", Bytes64, 64);
alignment!("x86_64", Bytes32, 32);
alignment!("aarch64", Bytes16, 16);

impl<S: Simd, A: Alignment> Lanes<S, A> {
    /// `value` in every lane.
    #[inline(always)]
    pub fn new(simd: S, value: f64) -> Self {
        Self {
            simd,
            register: simd.splat_f64s(value),
            _aligned: [],
        }
    }

    #[inline(always)]
    fn with(self, register: S::f64s) -> Self {
        Self { register, ..self }
    }
}

/// Declares an operator between registers, and between a register and a number that is the same in every lane.
macro_rules! operator {
    ($Operator:ident, $operator:ident, $operation:ident) => {
        impl<S: Simd, A: Alignment> $Operator for Lanes<S, A> {
            type Output = Self;
            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                self.with(self.simd.$operation(self.register, other.register))
            }
        }

        impl<S: Simd, A: Alignment> $Operator<f64> for Lanes<S, A> {
            type Output = Self;
            #[inline(always)]
            fn $operator(self, other: f64) -> Self {
                $Operator::$operator(self, Self::new(self.simd, other))
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd, A: Alignment> Neg for Lanes<S, A> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.register))
    }
}

impl<S: Simd, A: Alignment> AddAssign for Lanes<S, A> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd, A: Alignment> Number for Lanes<S, A> {
    type Real = Self;
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::new(self.simd, value)
    }
    #[inline(always)]
    fn value(self) -> Self {
        self
    }
    #[inline(always)]
    fn chain(self, value: Self, _slope: Self) -> Self {
        value
    }
    #[inline(always)]
    fn chain_of<const K: usize>(_numbers: &[Self; K], value: Self, _slopes: &[Self; K]) -> Self {
        value
    }
    #[inline(always)]
    fn select(condition: S::m64s, yes: Self, no: Self) -> Self {
        Self::choose(condition, yes, no)
    }
    #[inline(always)]
    fn plus(self, known: Self) -> Self {
        self + known
    }
    #[inline(always)]
    fn times(self, known: Self) -> Self {
        self * known
    }
    #[inline(always)]
    fn of_one<const COLUMN: usize>(self) -> OfOne<Self> {
        OfOne {
            value: self,
            slope: self.constant(0.0),
        }
    }
    #[inline(always)]
    fn times_one<const COLUMN: usize>(self, one: OfOne<Self>) -> Self {
        self * one.value
    }
    #[inline(always)]
    fn plus_one<const COLUMN: usize>(self, one: OfOne<Self>) -> Self {
        self + one.value
    }
}

impl<S: Simd, A: Alignment> Real for Lanes<S, A> {}

impl<S: Simd, A: Alignment> Lanewise for Lanes<S, A> {
    const LANES: usize = S::F64_LANES;
    type Mask = S::m64s;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self::new(self.simd, value)
    }

    #[inline(always)]
    fn lane_by_lane(self, mut of: impl FnMut(usize) -> f64) -> Self {
        let mut register = self.with(S::f64s::zeroed());
        for (lane, value) in register.lanes_mut().iter_mut().enumerate() {
            *value = of(lane);
        }
        register
    }

    #[inline(always)]
    fn lanes(&self) -> &[f64] {
        cast_slice(std::slice::from_ref(&self.register))
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        cast_slice_mut(std::slice::from_mut(&mut self.register))
    }

    fn interleave<'a>(self, signals: &[&'a [f64]]) -> Cow<'a, [Self]> {
        let longest = signals.iter().map(|signal| signal.len()).max().unwrap_or(0);
        let mut together = vec![self; longest];
        for (lane, signal) in signals.iter().enumerate() {
            let last = signal.last().copied().unwrap_or(0.0);
            let values = signal.iter().copied().chain(std::iter::repeat(last));
            for (point, value) in together.iter_mut().zip(values) {
                point.lanes_mut()[lane] = value;
            }
        }
        Cow::Owned(together)
    }

    #[inline(always)]
    fn is_above(self, other: Self) -> S::m64s {
        self.simd.greater_than_f64s(self.register, other.register)
    }

    #[inline(always)]
    fn choose(mask: S::m64s, yes: Self, no: Self) -> Self {
        yes.with(yes.simd.select_f64s(mask, yes.register, no.register))
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.register))
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.with(self.simd.abs_f64s(self.register))
    }

    #[inline(always)]
    fn power_of_two(self) -> Self {
        let mut register = [(self + WHOLE).register];
        for bits in cast_slice_mut::<_, u64>(&mut register) {
            *bits = exponent_bits(*bits);
        }
        self.with(register[0])
    }

    #[inline(always)]
    fn vectorize<T: Task>(self, task: T) -> T::Output {
        self.simd.vectorize(Vectorized(task))
    }
}

struct Vectorized<T>(T);

impl<T: Task> WithSimd for Vectorized<T> {
    type Output = T::Output;
    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> T::Output {
        self.0.run()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::dual::Dual;

    /// Bits of values and slopes of what laws are made of, lane by lane, from lane `first` of all.
    struct Probe {
        first: usize,
    }

    impl LaneTask for Probe {
        type Output = Vec<Vec<u64>>;
        fn run<R: Real>(self, zero: R) -> Self::Output {
            let place = zero.lane_by_lane(|lane| 0.37 * (self.first + lane) as f64 - 0.9);
            let x = Dual::<1, R>::parameter(place, 0);
            let positive = x.abs() + 0.1;
            let results = [
                x * x / positive - x,
                x.tanh(),
                (x * 30.0).exp(),
                positive.sqrt(),
                x.sign() + x.step(),
                x.power(-3),
                positive.power_of(x),
                x.smooth_step(),
                x.sin() + x.atan(),
                Dual::select(place.is_positive(), x, -x),
            ];
            let bits = |lane: usize| {
                let both = results
                    .iter()
                    .flat_map(|dual| [dual.value, dual.partials[0]]);
                both.map(|real| real.lanes()[lane].to_bits()).collect()
            };
            (0..R::LANES).map(bits).collect()
        }
    }

    #[test]
    fn every_kind_of_register_has_the_bits_of_one_number() {
        let mut kinds = vec![in_lanes(Probe { first: 0 })];
        #[cfg(target_arch = "x86_64")]
        {
            use pulp::x86::{V3, V4};
            let probe = Probe { first: 0 };
            kinds.extend(V3::try_new().map(|v3| probe.run(Lanes::<_, Bytes32>::new(v3, 0.0))));
            let probe = Probe { first: 0 };
            kinds.extend(V4::try_new().map(|v4| probe.run(Lanes::<_, Bytes64>::new(v4, 0.0))));
        }
        for kind in kinds {
            let alone: Vec<Vec<u64>> = (0..kind.len())
                .flat_map(|first| Probe { first }.run(0.0))
                .collect();
            assert_eq!(kind, alone, "{} lanes", kind.len());
        }
    }
}
