//! Random messages about obstacles.

use super::{Random, Store, wrench};
use crate::Either;
use stiction_core::{ObstacleDescription, Parameter, Touch};
use stiction_wire::{
    CommandAmong, ContactAmong, Forces, Frame, List, ObstacleList, Reply, Report, ReportAmong,
    Room, SceneAmong, Subject,
};

impl Random {
    /// A refusal that only boards with capacity for obstacles send.
    fn subject_among(&mut self) -> Subject {
        let (obstacle, index) = (self.below(256), self.below(256));
        Subject::Scene(self.one(&[
            Parameter::ObstacleCount,
            Parameter::CornerCount,
            Parameter::Corners(obstacle),
            Parameter::Corner {
                obstacle,
                corner: index,
            },
            Parameter::Side {
                obstacle,
                side: index,
            },
            Parameter::ObstacleFrictionStatic(obstacle),
            Parameter::ObstacleFrictionDynamic(obstacle),
            Parameter::ObstacleMemory(obstacle),
            Parameter::Overlap(obstacle),
        ]))
    }
    fn touch(&mut self) -> Touch {
        let (on_body, obstacle, index) = (self.below(128), self.below(255), self.below(256));
        self.one(&[
            Touch::Surface {
                vertex: on_body,
                surface: index,
            },
            Touch::Side {
                vertex: on_body,
                obstacle,
                side: index,
            },
            Touch::Corner {
                obstacle,
                corner: index,
                body_side: on_body,
            },
        ])
    }
}

impl Store {
    /// Of every type; those about obstacles are the most frequent ones.
    pub(crate) fn frame(&self, random: &mut Random) -> Either<'_> {
        let (sequence, time) = (random.byte(), random.word());
        if random.flag() {
            let message = match random.below(4) {
                0..2 => CommandAmong::Common(self.command(random)),
                _ => CommandAmong::SceneAmong(SceneAmong {
                    scene: self.scene(random),
                    obstacles: ObstacleList::from(self.obstacles.as_slice()),
                }),
            };
            return Either::Command(Frame {
                sequence,
                time,
                message,
            });
        }
        let message = match random.below(6) {
            0..3 => ReportAmong::Common(self.report(random)),
            3 => ReportAmong::Room(Room {
                obstacles: random.byte(),
                corners: random.byte(),
            }),
            4 => ReportAmong::Common(Report::Reply(Reply {
                subject: random.subject_among(),
                ..self.reply(random)
            })),
            _ => ReportAmong::ForcesAmong(Forces {
                wrench: wrench(random.floats()),
                feedback: wrench(random.floats()),
                turns: random.word() as i32,
                contacts: List::from(self.contacts_among.as_slice()),
            }),
        };
        Either::Report(Frame {
            sequence,
            time,
            message,
        })
    }
}

/// Some obstacles, with a limit on the total number of corners.
pub(super) fn obstacles(
    random: &mut Random,
    longest: usize,
) -> Vec<ObstacleDescription<'static, f32>> {
    let mut left = random.below(longest + 1);
    let mut obstacles = Vec::new();
    for _ in 0..random.below(longest + 1) {
        let corners = random.below(left.min(9) + 1);
        left -= corners;
        let vertices: Vec<[f32; 2]> = (0..corners).map(|_| random.floats()).collect();
        obstacles.push(ObstacleDescription {
            // They live as long as the tests run.
            vertices: vertices.leak(),
            friction_static: random.float(),
            friction_dynamic: random.float(),
            memory: random.option(),
        });
    }
    obstacles
}

pub(super) fn contact_among(random: &mut Random) -> ContactAmong {
    ContactAmong {
        touch: random.touch(),
        direction: random.floats(),
        point: random.floats(),
        normal: random.float(),
        friction: random.float(),
        sliding: random.one(&[0, 1, -1]),
    }
}
