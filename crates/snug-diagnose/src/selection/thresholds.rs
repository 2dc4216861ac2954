//! Thresholds of what is added, kept and called a twin.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Family-wise p below which a large but unsupported candidate leaves the verdict open. Chosen.
pub(crate) const PROMISING_P: f64 = 0.3;
/// Share of the misfit beyond the noise from which an unsupported candidate does so, too \[–\]. Chosen.
pub(crate) const GOOD_PART: f64 = 0.2;
/// The same share of an error of which nobody knows how much is noise \[–\]. Chosen: a ripple that took 85 % of what eight recordings left,
/// held out one by one, was no better than chance among all candidates.
pub(crate) const MOST: f64 = 0.5;
/// Standard deviations within which two candidates explain equally much: about 95 %.
pub(crate) const EQUAL: f64 = 2.0;
/// Share of what a candidate explains that another must explain, too, to keep up with it \[–\]. Chosen.
pub(crate) const AS_MUCH: f64 = 0.5;
/// The same of a simpler effect, to be named in its place \[–\]. Chosen.
pub(crate) const JUST_AS_MUCH: f64 = 0.98;
/// Share of the squared error of the study's own model that a simpler effect may leave more than a richer one, to be named in its place
/// \[–\]. Chosen: a rig with two motors is left 2.5 % more by dry friction than by a friction that builds up over 14 rad.
pub(crate) const NEARLY_AS_MUCH: f64 = 0.05;
/// Share of what a law in no catalogue, or an effect with numbers of its own in each recording, takes from the squared error that a known
/// one, or one that all recordings share, must take to come in first \[–\]. Chosen: of a motor that turns one way dry friction takes
/// 79 % of the error, a damping that falls with the torque 97 %; of one that turns both ways, each in recordings of its own, an offset of
/// the torque takes 81 %, one of each recording's output 92 %.
pub(crate) const MOST_OF_RICHER: f64 = 0.75;
/// Squared error that the known or shared one leaves, over that of the other, up to which it comes in first all the same \[–\]. Chosen:
/// it leaves 7 and 2.4 times as much in those two; of a tachometer that reads too much an offset of the torque takes 89 % and leaves
/// 2700 times as much as that of the output.
pub(crate) const MANY_TIMES: f64 = 100.0;
/// Squared error with a law in no catalogue over that with what was added in its place, up to which the law is the likelier story, where
/// it needs as many effects, one fewer, or more fewer \[–\]. Chosen: two effects of the catalogue that leave as little are the likelier story.
pub(crate) const ONE_LAW: [f64; 3] = [0.5, 0.98, 1.05];
/// The same before the end, of a law that plainly does for what came in since \[–\]. Chosen: a spring that is stiffer between two stops leaves 0.56
/// of what play and a general loop do in its place, 1.08 of what those leave with a relaxation.
pub(crate) const PLAINLY_ONE_LAW: [f64; 3] = [0.0, 0.75, 0.75];
/// Times the law's squared error that the known effect must have left in its place \[–\]. Chosen: springs of x |x| were called cubic with
/// a ripple, or exponential with play and a spring in series with a damper, where the known one alone left 10 to 30 times as much.
pub(crate) const MUCH_MORE: f64 = 3.0;
/// Times the squared error of what was added that a law may leave to be tried in its place beside all that came in since \[–\], ... Chosen:
/// of a cylinder that pulls with less than it pushes, the law and a damper that is stronger one way left as much without dry friction.
pub(crate) const CAME_AS_NEAR: f64 = 1.2;
/// ... and how many such laws are. Chosen.
pub(crate) const FEW_LAWS: usize = 3;
/// Share of the squared error up to which a law that bends to a little of everything may leave, to be believed \[–\]. Chosen: of the
/// hysteretic benchmark's rig, whose law it is, a general loop leaves 0.1 %.
pub(crate) const LEAVES_OF_GENERAL: f64 = 0.02;
/// Candidates, the best, whose simulation must be resolved \[–\]. Chosen: one that is not may come second to a law that is fitted to what the
/// simulation makes of it.
pub(crate) const RESOLVED: usize = 3;
/// Growth of the squared residual of a long record that is no matter of chance \[–\]. Chosen.
pub(crate) const PLAINLY_MORE: f64 = 1.3;
/// Share of the squared error of the study's own model below which, where the noise is not known, an effect is told as small
/// \[–\]: of a rig with two motors friction and offset take 91 %, and what is left changes with how warm it is; two effects take 2.6
/// and 2 % of it, and an engineer names neither. Of a drive three took 0.7 %. Beside a spring of air, told as quadratic and cubic, play, a
/// relaxation and an offset took 34, 11 and 7 % of what was left, a motion as before: less than `MOST` of that is none.
pub(crate) const SMALL: f64 = 0.05;
/// Share of what the others leave that an effect must take to be told whatever it is of all \[–\]. Chosen: beside an angle that is read 5 rad
/// too large friction takes more than 99 %; of a linear axis with friction alone an offset that is not there took 56 % of the rest and 0.03 %
/// of all, restarted from a measured angle a second mode that is not there 83 % and 2 %.
pub(crate) const NEARLY_ALL: f64 = 0.9;
/// Share of what an effect takes from the error by which a richer one may differ from it, summed over all clusters, and still do nothing
/// but the same \[–\]. Chosen.
pub(crate) const NO_OTHER: f64 = 0.02;
/// The same below which a law that is in no catalogue is not believed \[–\]: nobody calls a rig unknown for it. Chosen: a drive's friction
/// removed 99 %, five laws after it 0.7 %; of a rig with two motors friction and offset 91 %, a law after them 4.7 %.
pub(crate) const MATTERS: f64 = 0.1;
/// The same below which an effect of the catalogue is not added any more \[–\], unless it takes `MOST` of what is left: a fan's air was
/// told 6 % too thin without the friction of its bearing, which takes three quarters of the rest and 0.03 % of all. Chosen.
pub(crate) const TRIFLE: f64 = 0.001;
/// Share of what is left that one below it must take where the model is to predict \[–\]. Chosen: 5 % of the error with which it predicts.
pub(crate) const OF_PREDICTIONS: f64 = 0.1;
/// Share of a model's squared residual up to which it must be left with a twin in an effect's place for that to take it \[–\], of few long
/// records. Chosen: a load cell that drifts leaves 0.6 of what a place that drifts does, which both were told while friction was missing.
pub(crate) const PLAINLY_BETTER: f64 = 0.9;
/// Effects a model can be extended by before the search is called off. Chosen.
pub(crate) const MOST_EFFECTS: usize = 5;
/// Share of the misfit left by one effect beyond which two are tried together \[–\]. Chosen.
pub(crate) const MUCH_LEFT: f64 = 0.02;
/// Share of the misfit left by two effects below which no other two are looked for \[–\]. Chosen; with it two rankings in five
/// are spared.
pub(crate) const LITTLE_LEFT: f64 = 0.05;
/// Tightenings that are enough to find the second of two effects. Chosen; with it thousands take 1 min 11 s in place of 2 min.
pub(crate) const ENOUGH_AHEAD: usize = 80;
/// Share of a model's squared residual that must be left from another place for that to be a better one \[–\]. Chosen: far beyond
/// where fits of one model end apart.
pub(crate) const ESCAPED: f64 = 0.99;
/// Times that a model is led out of a poor minimum by its extensions. Chosen.
pub(crate) const MOST_ESCAPES: usize = 2;
/// Effects from which a second is looked for, and whose ends are tried for the model without them. Chosen.
pub(crate) const SEEDS: usize = 3;
