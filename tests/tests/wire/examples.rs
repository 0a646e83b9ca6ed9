//! The code sends and decodes the examples of FRAME.md.

use crate::decoded;
use crate::said::Said;
use std::collections::BTreeSet;

/// The specification.
const FRAME: &str = include_str!("../../../core/wire/FRAME.md");

/// The bytes of every example and its content.
pub(crate) fn examples() -> Vec<(Vec<u8>, Said)> {
    let (_, section) = FRAME.split_once("\n## 10. Examples\n").expect("section 10");
    let blocks = section.split("```text\n").skip(1);
    blocks
        .map(|block| {
            let (block, _) = block.split_once("\n```").expect("the end of an example");
            let (hex, fields) = block.split_at(block.find("type = ").expect("a type"));
            let bytes = hex
                .split_whitespace()
                .map(|byte| u8::from_str_radix(byte, 16).expect("hex"));
            (bytes.collect(), Said::parse(fields))
        })
        .collect()
}

#[test]
fn examples_of_the_specification_hold() {
    for (wire, said) in examples() {
        let to_board = decoded(&wire, true, |received| received.is_ok());
        decoded(&wire, to_board, |received| {
            let frame = received.expect("an example is a frame");
            assert_eq!(Said::of(&frame), said);
            assert_eq!(frame.encoded(), wire);
        });
    }
}

#[test]
fn there_is_an_example_of_every_type() {
    let types: BTreeSet<_> = examples()
        .iter()
        .map(|(_, said)| format!("{:?}", said.0["type"]))
        .collect();
    assert_eq!(types.len(), 18, "{types:?}");
}
