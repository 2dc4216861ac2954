//! Jobs that stand still: a scheduler that loses a worker in the instant in which it hands it work waits for it for ever.

use super::thresholds::{DEAD_AFTER_S, HEARTBEAT_S};
use ballista_core::JobId;
use ballista_scheduler::scheduler_server::{SchedulerServer, timestamp_secs};
use ballista_scheduler::state::execution_graph::ExecutionGraph;
use datafusion_proto::protobuf::{LogicalPlanNode, PhysicalPlanNode};
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// The scheduler with the plans that clients send.
pub(super) type Server = SchedulerServer<LogicalPlanNode, PhysicalPlanNode>;

/// Whatever changes when a part of a job is finished, begun, or given to another worker.
#[derive(Debug, PartialEq)]
struct Mark {
    finished_stages: usize,
    waiting: usize,
    running: Vec<(usize, usize, String)>,
}

impl Mark {
    fn of(graph: &dyn ExecutionGraph) -> Self {
        let running = graph.running_tasks().into_iter();
        let mut running: Vec<_> = running
            .map(|task| (task.stage_id, task.task_id, task.executor_id))
            .collect();
        running.sort();
        Self {
            finished_stages: graph.completed_stages(),
            waiting: graph.available_tasks(),
            running,
        }
    }
}

/// Since when each job is as it is.
#[derive(Debug, Default)]
struct Marks(HashMap<JobId, (Mark, Instant)>);

impl Marks {
    /// For how long a job has stood still; nothing for one of which a part runs where somebody is alive.
    fn still_for(
        &mut self,
        job: &JobId,
        mark: Mark,
        is_alive: impl Fn(&str) -> bool,
        now: Instant,
    ) -> Duration {
        let runs = mark.running.iter().any(|(.., worker)| is_alive(worker));
        match self.0.get(job) {
            Some((known, since)) if !runs && *known == mark => now.duration_since(*since),
            _ => {
                self.0.insert(job.clone(), (mark, now));
                Duration::ZERO
            }
        }
    }
}

/// Ends every job that stands still for so long, as long as the scheduler is there.
pub(super) async fn end_what_stands_still(server: Server, after: Duration) {
    let mut marks = Marks::default();
    loop {
        tokio::time::sleep(Duration::from_secs(HEARTBEAT_S).min(after)).await;
        let jobs = server.state.task_manager.get_running_job_cache();
        marks.0.retain(|job, _| jobs.contains_key(job));
        for (job, known) in jobs.iter() {
            let mark = Mark::of(known.execution_graph.read().await.as_ref());
            let still = marks.still_for(
                job,
                mark,
                |worker| is_alive(&server, worker),
                Instant::now(),
            );
            if still < after {
                continue;
            }
            tracing::warn!(%job, "stands still for {still:.0?}: no part runs at a living worker");
            if let Err(error) = server.cancel_job(job.clone()).await {
                tracing::error!(%job, %error, "cannot be ended");
            }
        }
    }
}

fn is_alive(server: &Server, worker: &str) -> bool {
    let heard = server.state.executor_manager.get_executor_hearbeat(worker);
    heard.is_some_and(|heard| heard.timestamp + DEAD_AFTER_S > timestamp_secs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(waiting: usize, running: &[(usize, &str)]) -> Mark {
        Mark {
            finished_stages: 0,
            waiting,
            running: (running.iter())
                .map(|&(task, worker)| (1, task, worker.to_owned()))
                .collect(),
        }
    }

    #[test]
    fn only_a_job_that_nobody_living_works_at_stands_still() {
        let (mut marks, job) = (Marks::default(), JobId::from("a".to_owned()));
        let begin = Instant::now();
        let alive = |worker: &str| worker == "alive";
        let mut at = |mark: Mark, s: u64| {
            let now = begin + Duration::from_secs(s);
            marks.still_for(&job, mark, alive, now).as_secs()
        };
        // With nobody there its parts wait.
        assert_eq!(at(mark(4, &[]), 0), 0);
        assert_eq!(at(mark(4, &[]), 9), 9);
        // One is begun, and takes as long as it takes.
        assert_eq!(at(mark(3, &[(0, "alive")]), 10), 0);
        assert_eq!(at(mark(3, &[(0, "alive")]), 500), 0);
        // It was given to a worker that died in that instant.
        assert_eq!(at(mark(3, &[(0, "dead")]), 510), 0);
        assert_eq!(at(mark(3, &[(0, "dead")]), 540), 30);
        // A part that is finished is progress.
        assert_eq!(at(mark(2, &[(0, "dead")]), 541), 0);
    }
}
