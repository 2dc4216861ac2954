//! Threads that make fits. Each is kept for the next fit, since what a thread allocated and others still hold lies scattered when it
//! ends.

use super::locked;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, OnceLock};

type Job = Box<dyn FnOnce() + Send>;
/// A job, and where the thread that does it takes the next.
struct Order(Job, Sender<Order>);

/// Threads that wait, and one that tests are made on.
#[derive(Default)]
pub(crate) struct Workers {
    idle: Arc<Mutex<Vec<Sender<Order>>>>,
    alone: OnceLock<Option<rayon::ThreadPool>>,
}

impl Workers {
    /// Does `job` on a thread that waits, or on one more.
    pub(crate) fn run(&self, job: impl FnOnce() + Send + 'static) {
        let waits = locked(&self.idle).pop();
        let worker = waits.unwrap_or_else(|| self.one_more());
        let order = Order(Box::new(job), worker.clone());
        if let Err(refused) = worker.send(order) {
            // The thread died in its last job.
            let worker = self.one_more();
            let order = Order(refused.0.0, worker.clone());
            let _ = worker.send(order);
        }
    }

    /// One processor for what may take its time.
    pub(crate) fn alone(&self) -> Option<&rayon::ThreadPool> {
        let one = || rayon::ThreadPoolBuilder::new().num_threads(1).build().ok();
        self.alone.get_or_init(one).as_ref()
    }

    /// A thread that ends once nobody knows it any more.
    fn one_more(&self) -> Sender<Order> {
        let (sender, orders) = channel::<Order>();
        let idle = Arc::downgrade(&self.idle);
        std::thread::spawn(move || {
            while let Ok(Order(job, own)) = orders.recv() {
                job();
                if let Some(idle) = idle.upgrade() {
                    locked(&idle).push(own);
                }
            }
        });
        sender
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::thread::{ThreadId, current};

    fn thread_of_a_job(workers: &Workers) -> ThreadId {
        let (tell, told) = channel();
        workers.run(move || tell.send(current().id()).unwrap());
        let id = told.recv().unwrap();
        // It is told before the thread waits again.
        while locked(&workers.idle).is_empty() {
            std::thread::yield_now();
        }
        id
    }

    #[test]
    fn one_job_after_the_other_takes_one_thread() {
        let workers = Workers::default();
        let first = thread_of_a_job(&workers);
        assert_eq!(thread_of_a_job(&workers), first);
    }

    #[test]
    fn jobs_at_the_same_time_take_a_thread_each() {
        let (workers, (tell, told)) = (Workers::default(), channel());
        let (go, wait) = channel::<()>();
        let other = tell.clone();
        workers.run(move || {
            wait.recv().unwrap();
            other.send(current().id()).unwrap();
        });
        workers.run(move || tell.send(current().id()).unwrap());
        let second = told.recv().unwrap();
        go.send(()).unwrap();
        assert_ne!(told.recv().unwrap(), second);
    }
}
