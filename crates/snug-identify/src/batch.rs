//! Fits that go abreast: each is written as if it were alone, and where it needs simulations it waits until every other one
//! needs some, too. Then all are made side by side, as many at a time as the processor's vector registers hold.
//!
//! A fit is a future, and all it ever waits for is a [`BatchSimulator`]. Nothing runs in the background: whoever calls
//! [`BatchSimulator::finish`] does the work. A simulation has the same bits whatever stands beside it, and so has a fit.

use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_model::{Input, Model, Run, simulate_side_by_side};
use std::cell::{RefCell, RefMut};
use std::future::poll_fn;
use std::pin::pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

/// A simulation that a fit needs; its room is given along, and comes back filled.
pub(crate) struct SimulationRequest<'a> {
    pub model: &'a Model,
    pub input: &'a Input,
    pub quantity: Quantity,
    /// Of all parameters.
    pub values: Vec<f64>,
    /// Parameters to which derivatives are asked for; may be none.
    pub free: Vec<usize>,
    /// One value per sample.
    pub output: Vec<f64>,
    /// Column-major, samples × free.
    pub sensitivity: Vec<f64>,
    /// Whether it has been made.
    pub is_done: bool,
}

impl SimulationRequest<'_> {
    /// It is made by whoever asks for this.
    fn run(&mut self) -> Run<'_> {
        self.is_done = true;
        let room = self.output.len() * self.free.len();
        Run {
            model: self.model,
            values: &self.values,
            input: self.input,
            quantity: self.quantity,
            output: &mut self.output,
            sensitivity: &mut self.sensitivity[..room],
        }
    }

    /// Whether the two, the shorter first, are worth being made side by side: lanes last as long as their longest run.
    fn suits(&self, longer: &Self) -> bool {
        self.free == longer.free && 3 * self.output.len() >= 2 * longer.output.len()
    }
}

/// Makes the simulations that fits wait for.
#[derive(Default)]
pub(crate) struct BatchSimulator<'a> {
    waiting: RefCell<Vec<Rc<RefCell<Vec<SimulationRequest<'a>>>>>>,
}

/// Fits that are under way at a time: four times as many as there are lanes, since not all need the same kind of simulation
/// at the same time.
const UNDER_WAY: usize = 4 * WIDEST;

/// Lanes of the widest vector registers.
const WIDEST: usize = 8;

impl<'a> BatchSimulator<'a> {
    /// What was asked for, once it has been its turn.
    pub async fn simulate(
        &self,
        requests: Vec<SimulationRequest<'a>>,
    ) -> Vec<SimulationRequest<'a>> {
        let requests = Rc::new(RefCell::new(requests));
        self.waiting.borrow_mut().push(Rc::clone(&requests));
        poll_fn(|_| match is_done(&requests.borrow()) {
            true => Poll::Ready(()),
            false => Poll::Pending,
        })
        .await;
        requests.take()
    }

    /// Lets all `fits` go to their ends; what they come to, in their order. One that has ended makes room for the next.
    pub fn finish<T>(&self, fits: impl IntoIterator<Item = impl Future<Output = T>>) -> Vec<T> {
        let mut to_come = fits.into_iter().map(Box::pin).enumerate();
        let mut under_way = Vec::new();
        let mut ended: Vec<(usize, T)> = Vec::new();
        let mut context = Context::from_waker(Waker::noop());
        loop {
            under_way.extend(to_come.by_ref().take(UNDER_WAY - under_way.len()));
            if under_way.is_empty() {
                break;
            }
            under_way.retain_mut(|(index, fit)| match pin!(fit).poll(&mut context) {
                Poll::Ready(outcome) => {
                    ended.push((*index, outcome));
                    false
                }
                Poll::Pending => true,
            });
            self.simulate_most();
        }
        ended.sort_by_key(|(index, _)| *index);
        ended.into_iter().map(|(_, outcome)| outcome).collect()
    }

    /// Makes, of everything that is waited for, the kind that most wait for, as far as it fills lanes. The others wait on, and
    /// become more.
    fn simulate_most(&self) {
        let mut waiting = self.waiting.borrow_mut();
        let mut lists: Vec<RefMut<'_, _>> = waiting.iter().map(|list| list.borrow_mut()).collect();
        let mut requests: Vec<&mut SimulationRequest<'a>> = (lists.iter_mut())
            .flat_map(|list| list.iter_mut().filter(|request| !request.is_done))
            .collect();
        requests.sort_by(|one, other| {
            (&one.free, one.output.len()).cmp(&(&other.free, other.output.len()))
        });
        let alike = requests.chunk_by_mut(|one, next| one.suits(next));
        if let Some(most) = alike.max_by_key(|alike| alike.len()) {
            let free = most[0].free.clone();
            let few = if most.len() > WIDEST {
                most.len() % WIDEST
            } else {
                0
            };
            let mut runs: Vec<Run<'_>> = (most.iter_mut().skip(few))
                .map(|request| request.run())
                .collect();
            simulate_side_by_side(&mut runs, &free)
                .expect("a residual asks only for what can be simulated");
        }
        drop(lists);
        waiting.retain(|list| !is_done(&list.borrow()));
    }
}

fn is_done(requests: &[SimulationRequest<'_>]) -> bool {
    requests.iter().all(|request| request.is_done)
}

/// Tightenings of one batch: more than the widest vector registers hold, since fits end one by one, and few enough to be shared
/// out among threads.
pub const SIDE_BY_SIDE: usize = 16;

/// Does `work` with batch after batch of `items`; what comes of each item, in their order.
///
/// # Errors
/// The first that `work` gives.
pub fn in_batches<T: Sync, R: Send, E: Send>(
    items: &[T],
    work: impl Fn(&[T]) -> Result<Vec<R>, E> + Sync,
) -> Result<Vec<R>, E> {
    let done: Vec<Vec<R>> = (items.par_chunks(SIDE_BY_SIDE))
        .map(&work)
        .collect::<Result<_, E>>()?;
    Ok(done.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::{Intersample, Rig};

    /// Each fit asks as often as its number says, with one value more each time, and adds up what it gets.
    #[test]
    fn everyone_gets_what_was_asked_for_and_ends_in_its_place() {
        let rig = Rig {
            lever_arm_m: 0.5,
            known_inertia_kg_m2: 0.1,
        };
        let model = Model::new(rig, &[]).unwrap();
        let inputs: Vec<Input> = [300, 40]
            .map(|samples| Input::new(&vec![2.0; samples], 1e-3, Intersample::Linear))
            .into();
        let request = |number: usize, asked: usize| {
            let input = &inputs[number % 2];
            SimulationRequest {
                model: &model,
                input,
                quantity: Quantity::Displacement,
                values: vec![2.0 + number as f64, 80.0 + asked as f64, 2000.0],
                free: vec![2; number % 3 / 2],
                output: vec![0.0; input.samples()],
                sensitivity: vec![0.0; input.samples()],
                is_done: false,
            }
        };
        let sum = |request: &SimulationRequest<'_>| -> f64 {
            request.output.iter().chain(&request.sensitivity).sum()
        };
        let count = UNDER_WAY + 30;
        let simulator = BatchSimulator::default();
        let found = simulator.finish((0..count).map(|number| {
            let simulator = &simulator;
            async move {
                let mut sums = Vec::new();
                for asked in 0..number % 7 {
                    let requests = vec![request(number, asked), request(number + 1, asked)];
                    sums.extend(simulator.simulate(requests).await.iter().map(sum));
                }
                sums
            }
        }));
        assert_eq!(found.len(), count);
        for (number, sums) in found.iter().enumerate() {
            let expected = (0..number % 7).flat_map(|asked| {
                [number, number + 1].map(|of| {
                    let mut alone = request(of, asked);
                    let free = alone.free.clone();
                    simulate_side_by_side(&mut [alone.run()], &free).unwrap();
                    sum(&alone)
                })
            });
            assert_eq!(*sums, expected.collect::<Vec<_>>());
        }
    }
}
