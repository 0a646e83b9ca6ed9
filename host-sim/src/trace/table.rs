//! A trace record as one CSV row: arrays flattened, events separated by spaces, the first four contacts.

use super::{ContactEntry, Record, Value};

/// Contacts in a row; columns of absent ones are empty.
const CONTACTS: usize = 4;
const CONTACT_COLUMNS: [&str; 7] = [
    "vertex", "surface", "x", "y", "normal", "friction", "sliding",
];
const COLUMNS: [&str; 17] = [
    "t",
    "hand_x",
    "hand_y",
    "hand_phi",
    "held",
    "pose_x",
    "pose_y",
    "pose_theta",
    "depth",
    "state",
    "wrench_x",
    "wrench_y",
    "wrench_moment",
    "slips",
    "events",
    "status",
    "contacts",
];

/// The names of the columns.
pub(super) fn header() -> Vec<String> {
    let mut names: Vec<String> = COLUMNS.map(String::from).to_vec();
    for contact in 0..CONTACTS {
        names.extend(CONTACT_COLUMNS.map(|column| format!("c{contact}_{column}")));
    }
    names
}

/// The columns of a record.
pub(super) fn row(record: &Record<'_>) -> Vec<String> {
    let mut row = vec![format!("{:?}", record.t)];
    row.extend(record.hand.map(digits));
    row.push(record.held.to_string());
    row.extend(record.pose.map(digits));
    row.push(digits(record.depth));
    row.push(record.state.to_owned());
    row.extend(record.wrench.map(digits));
    row.push(record.slips.to_string());
    row.push(record.events.join(" "));
    row.push(record.status.to_owned());
    row.push(record.contacts.len().to_string());
    for contact in record.contacts.iter().take(CONTACTS) {
        row.extend(contact_columns(contact));
    }
    row.resize(
        COLUMNS.len() + CONTACTS * CONTACT_COLUMNS.len(),
        String::new(),
    );
    row
}

fn contact_columns(contact: &ContactEntry<'_>) -> [String; CONTACT_COLUMNS.len()] {
    let [x, y] = contact.point;
    [
        contact.vertex.to_string(),
        contact.surface.to_owned(),
        digits(x),
        digits(y),
        digits(contact.normal),
        digits(contact.friction),
        contact.sliding.to_string(),
    ]
}

fn digits(Value { value, single }: Value) -> String {
    if single {
        format!("{:?}", value as f32)
    } else {
        format!("{value:?}")
    }
}
