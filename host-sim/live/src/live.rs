//! The solver tick by tick, with its hand: what happens in a millisecond, and what is shown afterwards.

use std::sync::Arc;

use stiction_scene::Sample;
use web_time::{Duration, Instant};

use crate::body::Setting;
use crate::change::Change;
use crate::echo::Echoes;
use crate::feed::{Latest, Pending};
use crate::guide::{Guide, HandPose};
use crate::holder::{Holder, Source};
use crate::outbound::{self, By, Fares, Replayed, Status};
use crate::pair::Pair;
use crate::replay::Replay;
use crate::scenes::Offer;
use crate::stage::Stage;
use crate::step_times::StepTimes;

/// Time between two ticks.
pub const PERIOD: Duration = Duration::from_millis(1);
/// Largest delay that is caught up.
const PATIENCE: Duration = Duration::from_millis(100);
/// Number of clients' scenes that stay available, each at most 1 MiB.
const MOST_OWN: usize = 32;
/// Time in a tick that a seek may use.
const SEEKING: Duration = Duration::from_micros(500);

/// The solver with its hand.
pub struct Live {
    /// Data that waits to be shown.
    pub pending: Pending,
    /// The scene as it is after a reset.
    pub stage: Stage,
    /// The solver and the reference.
    pub pair: Pair,
    /// The hand of the newest tick.
    pub sample: Sample,
    /// Times of the steps.
    pub times: StepTimes,
    /// Leads the live hand.
    pub guide: Guide,
    /// The holder of the hand.
    pub holder: Holder,
    /// The path that the hand follows instead.
    pub replay: Option<Replay>,
    /// Scenes other than the bundled ones, the newest last.
    pub own: Arc<Vec<Stage>>,
    /// Why the scene's file, in its present form, cannot be shown.
    pub scene_problem: Option<String>,
    /// The number of the newest tick.
    pub tick: u64,
    /// Whether time stands still.
    pub paused: bool,
    /// Ticks still to be made while paused.
    pub steps: u32,
    /// Speed of the solver's time: 1 is real time.
    pub speed: f64,
    /// Fraction of a tick that has passed.
    phase: f64,
    /// Number of clients.
    pub clients: usize,
    /// Values that clients sent with their samples.
    pub echoes: Echoes,
    /// Whether the state has changed.
    pub changed: bool,
}

impl Live {
    /// Starts with a scene, the body at its start.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub fn new(stage: Stage, setting: &Setting) -> Result<Self, String> {
        let pair = Pair::start(setting, 0.0, &stage.home)?;
        let mut live = Self {
            pending: Pending::default(),
            guide: Guide::at(HandPose::of(&stage.home)),
            sample: Sample {
                t: 0.0,
                hand: stage.home,
            },
            stage,
            pair,
            times: StepTimes::default(),
            holder: Holder::default(),
            replay: None,
            own: Arc::default(),
            scene_problem: None,
            tick: 0,
            paused: false,
            steps: 0,
            speed: 1.0,
            phase: 0.0,
            clients: 0,
            echoes: Echoes::default(),
            changed: true,
        };
        live.pending.record(&live.pair.frame);
        Ok(live)
    }

    /// Counts a tick that begins more than `allowed` late. Returns when it was due, or `now` if that is too long ago.
    pub fn late(&mut self, due: Instant, now: Instant, allowed: Duration) -> Instant {
        let late = now.saturating_duration_since(due);
        let skips = late > PATIENCE;
        if self.moves() && late > allowed {
            self.pair.counts.missed += if skips { late.as_millis() as u64 } else { 1 };
        }
        if skips { now } else { due }
    }

    /// Returns whether ticks are made.
    fn moves(&self) -> bool {
        let ended = self.replay.as_ref().is_some_and(Replay::is_over);
        !self.paused && !ended
    }

    /// Lets a period pass. `advance` makes a tick, and returns whether another one may follow in the same period.
    pub fn pass(&mut self, advance: &mut dyn FnMut(&mut Self) -> bool) {
        if self.replay.as_ref().is_some_and(Replay::is_seeking) {
            self.approach();
        } else if self.steps > 0 {
            // As many as there is time for.
            let begun = Instant::now();
            while self.steps > 0 && begun.elapsed() < SEEKING {
                self.steps -= 1;
                if !advance(self) {
                    break;
                }
            }
        } else if !self.paused {
            self.phase += self.speed;
            if self.phase >= 1.0 {
                self.phase -= 1.0;
                advance(self);
            }
        }
    }

    fn approach(&mut self) {
        let begun = Instant::now();
        if let Some(replay) = &mut self.replay {
            while replay.is_seeking() && begun.elapsed() < SEEKING {
                replay.approach(&mut self.pair, &mut self.times);
                self.changed |= replay.takes_change();
                self.pending.record(&self.pair.frame);
            }
            self.tick = replay.at as u64;
        }
    }

    /// Moves the hand along its path; `follows`: the body follows it here. Returns nothing if there is no path or it is at its
    /// end.
    pub fn follow(&mut self, follows: bool) -> Option<()> {
        let replay = self.replay.as_mut()?;
        let sample = match follows {
            false => replay.go_on(),
            true => replay.advance(&mut self.pair, &mut self.times),
        };
        self.changed |= replay.takes_change();
        if sample.is_none() && replay.rest() {
            // Cannot fail: the first snapshot exists, or the scene has been started before.
            let _ = self.seek(0.0);
            return None;
        }
        (self.sample, self.tick) = (sample?, replay.at as u64);
        if follows {
            self.pending.record(&self.pair.frame);
        }
        Some(())
    }

    /// Sets the hand of the next tick.
    pub fn move_hand(&mut self, hand: HandPose) -> Sample {
        self.tick += 1;
        self.sample = Sample {
            t: self.tick as f64 / 1000.0,
            hand: hand.hand(),
        };
        self.sample
    }

    /// Makes the body follow the newest hand.
    pub fn step(&mut self) {
        let Sample { t, hand } = self.sample;
        self.echoes.move_now();
        self.pair.step(t, &hand, &mut self.times);
        self.pending.record(&self.pair.frame);
    }

    /// Makes one tick of a body that nobody records.
    pub fn advance(&mut self) {
        if self.replay.is_some() {
            self.follow(true);
        } else {
            let hand = self.guide.advance();
            self.move_hand(hand);
            self.step();
        }
    }

    /// Removes a client. A demonstration that nobody watches any more ends, as if it had not been shown.
    pub fn left(&mut self, client: u32) {
        self.clients = self.clients.saturating_sub(1);
        self.holder.leave(Source::Client(client));
        self.changed = true;
        let replay = self.replay.as_ref();
        if self.clients == 0 && replay.is_some_and(Replay::is_demonstration) {
            // Cannot fail: the scene has been started before.
            let _ = self.apply(Change::run(self.stage.clone(), self.pair.setting.clone()));
        }
    }

    /// Starts to show another run, in which the hand begins at `home`.
    pub fn begin_run(&mut self, home: HandPose) {
        self.tick = self.replay.as_ref().map_or(0, |replay| replay.at as u64);
        let first = self.replay.as_ref().and_then(Replay::sample);
        self.sample = first.unwrap_or(Sample {
            t: 0.0,
            hand: home.hand(),
        });
        self.phase = 0.0;
        self.steps = 0;
        self.echoes = Echoes::default();
        self.pending.clear();
        self.pending.record(&self.pair.frame);
        self.changed = true;
    }

    /// Returns the hand of the newest frame.
    pub fn shown_hand(&self) -> HandPose {
        let frame = &self.pair.frame;
        HandPose {
            pose: frame.hand.map(|value| value + 0.0),
            depth: frame.depth,
            held: frame.held,
        }
    }

    /// Keeps a scene; it replaces another one of the same name.
    pub fn keep(&mut self, stage: Stage) {
        let scenes = Arc::make_mut(&mut self.own);
        scenes.retain(|own| own.scene.title != stage.scene.title);
        if scenes.len() == MOST_OWN {
            scenes.remove(0);
        }
        scenes.push(stage);
    }

    /// Returns the scenes that can be shown, those of clients first; `with_obstacles`: includes those with obstacles.
    pub fn offers(&self, with_obstacles: bool) -> Vec<Offer> {
        let is_own = |name: &str| self.own.iter().any(|own| own.scene.title == name);
        let own = self.own.iter();
        let own = own.map(|own| Offer::new(own.scene.title.clone(), own.scene.source().text()));
        let bundled = Offer::bundled(with_obstacles).filter(|offer| !is_own(&offer.name));
        own.chain(bundled).collect()
    }

    fn scene_names(&self, with_obstacles: bool) -> Vec<String> {
        let offers = self.offers(with_obstacles).into_iter();
        offers.map(|offer| offer.name).collect()
    }

    /// Queues the state, with this status, to be shown.
    pub fn tell(&mut self, status: &Status) {
        let message = outbound::state(&self.stage, &self.pair, status);
        self.pending.state(message);
        self.changed = false;
    }

    /// Returns the part of the state about time, hand, clients and scenes, without recordings; `with_obstacles`: scenes with
    /// obstacles can be shown.
    pub fn status(&self, with_obstacles: bool) -> Status {
        let hand = match (&self.replay, self.holder.source()) {
            (Some(_), _) => By {
                by: Some("replay"),
                client: None,
            },
            (None, source) => By {
                by: source.map(|source| source.name()),
                client: source.and_then(|source| source.client()),
            },
        };
        let replay = self.replay.as_ref().map(|replay| Replayed {
            what: replay.what.clone(),
            seconds: replay.seconds(),
            demonstration: replay.is_demonstration(),
        });
        Status {
            paused: self.paused,
            speed: self.speed,
            recording: None,
            recording_file: None,
            recorded: None,
            replay,
            hand,
            clients: self.clients,
            scenes: self.scene_names(with_obstacles),
            scene_problem: self.scene_problem.clone(),
        }
    }

    /// Returns the newest data; `board`: statistics of the board that runs the solver.
    pub fn latest(&self, board: Option<Fares>) -> Latest {
        let pair = &self.pair;
        Latest {
            tick: self.tick,
            frame: Arc::clone(&pair.frame),
            scene: Arc::clone(&pair.setting.scene),
            stage: self.stage.clone(),
            own: Arc::clone(&self.own),
            number: pair.setting.number,
            meter: pair.meter.clone(),
            echo: self.echoes.shown().clone(),
            reference: pair.comparison,
            counts: pair.counts,
            slips: Arc::clone(&pair.slips),
            step: board.is_none().then(|| self.times.summary()),
            board,
            position: self.replay.as_ref().map(Replay::position),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;
    use crate::scenes;
    use std::path::Path;
    use stiction_core::Evolution;
    use stiction_scene::SceneFile;

    #[test]
    fn the_speed_is_the_number_of_ticks_a_period() {
        let number = Number::F64;
        let source = scenes::find(Path::new("box-flat")).expect("a bundled scene");
        let scene = SceneFile::parse(source, number.limit()).expect("a scene");
        let stage = Stage::new(scene).expect("a stage");
        let setting = Setting {
            scene: stage.scene.clone(),
            number,
            evolution: Evolution::Path,
        };
        let mut live = Live::new(stage, &setting).expect("the scene fits");
        for (speed, expected) in [
            (1.0, 1024),
            (0.125, 128),
            (0.1, 102),
            (0.02, 20),
            (0.001, 1),
        ] {
            (live.speed, live.phase) = (speed, 0.0);
            let mut ticks = 0;
            for _ in 0..1024 {
                live.pass(&mut |_| {
                    ticks += 1;
                    true
                });
            }
            assert_eq!(ticks, expected, "at {speed}");
        }
        live.paused = true;
        live.pass(&mut |_| unreachable!("a tick while it pauses"));
    }
}
