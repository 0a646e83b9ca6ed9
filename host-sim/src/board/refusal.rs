//! Describes in words what a board refuses.

use stiction_core::Parameter;
use stiction_wire::{Reason, Subject};

use super::message::Answer;
use stiction_live::record::Names;

/// What was refused, its value, the allowed values, and the nearest allowed value, or the bound that the value must stay below.
pub(super) fn explain(command: &str, answer: &Answer, names: &Names) -> String {
    let mut text = format!("the board refuses the {command}");
    let subject = subject(answer.subject, names);
    let unit = unit(answer.subject);
    match (&subject, answer.reason) {
        (None, reason) => {
            text.push_str(": ");
            text.push_str(meaning(reason));
        }
        (Some(subject), reason) => {
            text.push_str(&format!(": {subject} is {:?}{unit}", answer.value));
            if reason != Reason::Number {
                text.push_str(", ");
                text.push_str(meaning(reason));
            }
        }
    }
    if !answer.allowed.is_empty() {
        text.push_str(&format!(", allowed: {}", answer.allowed));
    }
    if !answer.limit.is_nan() && subject.is_some() {
        let limit = if answer.reason == Reason::NotPassive {
            "the limit"
        } else {
            "the nearest"
        };
        text.push_str(&format!(", {limit}: {:?}{unit}", answer.limit));
    }
    text
}

const fn meaning(reason: Reason) -> &'static str {
    match reason {
        Reason::Done => "it is done",
        Reason::Version => "it speaks another version of the wire format",
        Reason::UnknownType => "it does not know this command",
        Reason::Length => "its length is not that of this command",
        Reason::Code => "it holds a code without a meaning",
        Reason::Number => "a number is not allowed",
        Reason::NotPassive => "the haptic device would not be passive",
        Reason::Unsupported => "the board has no time, no room or no use for it",
        Reason::NotNow => "not now: it is stopped by a fault, or another command is under way",
    }
}

fn subject(subject: Subject, names: &Names) -> Option<String> {
    let parameter = match subject {
        Subject::Command => return None,
        Subject::TickRate => return Some("the tick rate".to_owned()),
        Subject::LineRate => return Some("the load of the line".to_owned()),
        Subject::Scene(parameter) => parameter,
    };
    let name = match parameter {
        Parameter::Normal(i)
        | Parameter::Offset(i)
        | Parameter::FrictionStatic(i)
        | Parameter::FrictionDynamic(i)
        | Parameter::Memory(i)
        | Parameter::Penetration { surface: i, .. } => names.surfaces.get(i),
        Parameter::Corners(i)
        | Parameter::Corner { obstacle: i, .. }
        | Parameter::Side { obstacle: i, .. }
        | Parameter::ObstacleFrictionStatic(i)
        | Parameter::ObstacleFrictionDynamic(i)
        | Parameter::ObstacleMemory(i)
        | Parameter::Overlap(i) => names.obstacles.get(i),
        Parameter::VertexCount
        | Parameter::Vertex(_)
        | Parameter::Start
        | Parameter::Weight
        | Parameter::HoldingPoint
        | Parameter::Reach
        | Parameter::StiffnessTranslation
        | Parameter::StiffnessRotation
        | Parameter::SurfaceCount
        | Parameter::ObstacleCount
        | Parameter::CornerCount => None,
    };
    Some(match name {
        Some(name) => format!("the {parameter} ({name:?})"),
        None => format!("the {parameter}"),
    })
}

const fn unit(subject: Subject) -> &'static str {
    match subject {
        Subject::Command => "",
        Subject::TickRate => " Hz",
        Subject::LineRate => " bytes per second",
        Subject::Scene(parameter) => match parameter {
            Parameter::Weight => " N",
            Parameter::Reach
            | Parameter::Offset(_)
            | Parameter::HoldingPoint
            | Parameter::Vertex(_)
            | Parameter::Memory(_)
            | Parameter::Penetration { .. }
            | Parameter::Corner { .. }
            | Parameter::Side { .. }
            | Parameter::ObstacleMemory(_)
            | Parameter::Overlap(_) => " m",
            Parameter::StiffnessTranslation => " N/m",
            Parameter::StiffnessRotation => " N·m/rad",
            Parameter::VertexCount
            | Parameter::Start
            | Parameter::SurfaceCount
            | Parameter::Normal(_)
            | Parameter::FrictionStatic(_)
            | Parameter::FrictionDynamic(_)
            | Parameter::ObstacleCount
            | Parameter::CornerCount
            | Parameter::Corners(_)
            | Parameter::ObstacleFrictionStatic(_)
            | Parameter::ObstacleFrictionDynamic(_) => "",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_wire::Reference;

    fn answer(reason: Reason, subject: Subject, value: f32, limit: f32, allowed: &str) -> Answer {
        Answer {
            command: Reference {
                code: 4,
                sequence: 1,
            },
            reason,
            subject,
            value,
            limit,
            allowed: allowed.to_owned(),
        }
    }

    #[test]
    fn a_refused_number_comes_with_what_is_allowed_and_the_nearest() {
        let tick = answer(
            Reason::Unsupported,
            Subject::TickRate,
            5000.0,
            1000.0,
            "1 to 1000",
        );
        assert_eq!(
            explain("mode", &tick, &Names::default()),
            "the board refuses the mode: the tick rate is 5000.0 Hz, the board has no time, no room or no use for it, allowed: 1 to \
             1000, the nearest: 1000.0 Hz"
        );
    }

    #[test]
    fn the_limit_of_what_is_passive_is_not_called_allowed() {
        let spring = answer(
            Reason::NotPassive,
            Subject::Scene(Parameter::StiffnessTranslation),
            900.0,
            800.0,
            "0, or less than the limit",
        );
        let text = explain("parameters", &spring, &Names::default());
        assert!(
            text.ends_with(", allowed: 0, or less than the limit, the limit: 800.0 N/m"),
            "{text}"
        );
    }

    #[test]
    fn a_surface_is_called_by_its_name() {
        let subject = Subject::Scene(Parameter::FrictionDynamic(1));
        let friction = answer(Reason::Number, subject, -0.5, f32::NAN, "0 or more");
        let names = Names {
            surfaces: vec!["floor".to_owned(), "wall".to_owned()],
            obstacles: vec!["table".to_owned(), "post".to_owned()],
        };
        assert_eq!(
            explain("scene", &friction, &names),
            "the board refuses the scene: the dynamic friction of surface 1 (\"wall\") is -0.5, allowed: 0 or more"
        );
        let subject = Subject::Scene(Parameter::Overlap(1));
        let sunk = answer(Reason::Number, subject, 0.25, f32::NAN, "at most 1e-5");
        assert_eq!(
            explain("scene", &sunk, &names),
            "the board refuses the scene: the depth of the body in obstacle 1 at the start (\"post\") is 0.25 m, allowed: at most 1e-5"
        );
        let subject = Subject::Scene(Parameter::CornerCount);
        let many = answer(Reason::Unsupported, subject, 17.0, 16.0, "0 to 16");
        let text = explain("scene", &many, &names);
        assert!(
            text.contains("number of corners of all obstacles is 17.0, "),
            "{text}"
        );
        assert!(text.ends_with("the nearest: 16.0"), "{text}");
    }

    #[test]
    fn a_command_as_a_whole_is_refused_without_a_value() {
        let not_now = answer(Reason::NotNow, Subject::Command, 0.0, f32::NAN, "");
        let text = explain("scene", &not_now, &Names::default());
        assert!(text.ends_with("another command is under way"), "{text}");
    }
}
