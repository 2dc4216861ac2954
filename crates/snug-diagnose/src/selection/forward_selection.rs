//! The way up: rank, add the best, again, until nothing more is justified; then tidy up.

use crate::error::DiagnoseError;
use crate::selection::backward_elimination::{look_at_twins_again, try_removals};
use crate::selection::path::{Climb, Stop, justified};
use crate::selection::search::{MOST_EFFECTS, Search};

impl Search<'_> {
    /// Climbs from the study's own effects as far as the data justify, or until whoever watches ends it.
    pub fn improve(&self) -> Result<Climb, DiagnoseError> {
        let mut climb = self.compare()?;
        let ended = self.ascend(&mut climb);
        climb.until_interrupted(ended)
    }

    /// Rung by rung; `climb` holds those that were reached also where this fails.
    fn ascend(&self, climb: &mut Climb) -> Result<(), DiagnoseError> {
        loop {
            climb.ranking = self.rank(climb.last(), self.settings.control_campaigns)?;
            if climb.additions.len() >= MOST_EFFECTS {
                climb.stopped = Some(Stop::Full);
                break;
            }
            let best = match justified(&climb.ranking, climb.last(), self.settings) {
                Ok(best) => best,
                Err(stop) => {
                    climb.stopped = Some(stop);
                    break;
                }
            };
            let room = MOST_EFFECTS - climb.additions.len();
            for (addition, fitted) in self.choose(climb.last(), &climb.ranking, best, room)? {
                climb.add(addition, self.settled(&fitted)?);
            }
        }
        try_removals(self, climb)?;
        look_at_twins_again(self, climb)
    }
}
