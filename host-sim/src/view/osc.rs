//! Packets of Open Sound Control 1.0: messages with an address and arguments, alone or in bundles, to bytes and back.
//!
//! All numbers are big-endian. A text ends with a 0 byte and is filled up with more to a multiple of 4. A message is its address, a text of
//! a comma and a letter for each argument, and the arguments. A bundle is the text `#bundle`, a time of 8 bytes, and packets, each after its
//! length.

/// The start of a bundle.
const BUNDLE: &str = "#bundle";
/// Why a packet cannot be read.
const MALFORMED: &str = "a packet that is no whole OSC message or bundle";
const UNTYPED: &str = "an OSC message without the types of its arguments, allowed: a text of a comma and a letter for each, as `,fff`";
/// The time of a bundle: at once.
const AT_ONCE: u64 = 1;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Argument {
    Int(i32),
    Float(f32),
    Text(String),
    /// Of 64 bits: the number of a sender that has no other ones.
    Long(i64),
    Double(f64),
    Truth(bool),
    /// Of another type, with its letter.
    Other(char),
}

impl Argument {
    /// Its letter in a text of types.
    const fn letter(&self) -> char {
        match self {
            Self::Int(_) => 'i',
            Self::Float(_) => 'f',
            Self::Text(_) => 's',
            Self::Long(_) => 'h',
            Self::Double(_) => 'd',
            Self::Truth(true) => 'T',
            Self::Truth(false) => 'F',
            Self::Other(letter) => *letter,
        }
    }

    /// The number that it is, of whatever type; true is 1.
    pub(super) fn number(&self) -> Option<f64> {
        Some(match self {
            Self::Int(value) => f64::from(*value),
            Self::Float(value) => f64::from(*value),
            Self::Long(value) => *value as f64,
            Self::Double(value) => *value,
            Self::Truth(value) => f64::from(u8::from(*value)),
            Self::Text(_) | Self::Other(_) => return None,
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Message {
    pub(super) address: String,
    pub(super) arguments: Vec<Argument>,
}

fn put_text(text: &str, bytes: &mut Vec<u8>) {
    bytes.extend(text.bytes());
    bytes.push(0);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}

impl Message {
    /// The letters of its arguments.
    pub(super) fn types(&self) -> String {
        self.arguments.iter().map(Argument::letter).collect()
    }

    fn encode(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        put_text(&self.address, &mut bytes);
        put_text(&format!(",{}", self.types()), &mut bytes);
        for argument in &self.arguments {
            match argument {
                Argument::Int(value) => bytes.extend(value.to_be_bytes()),
                Argument::Float(value) => bytes.extend(value.to_be_bytes()),
                Argument::Text(text) => put_text(text, &mut bytes),
                Argument::Long(value) => bytes.extend(value.to_be_bytes()),
                Argument::Double(value) => bytes.extend(value.to_be_bytes()),
                Argument::Truth(_) | Argument::Other(_) => {}
            }
        }
        bytes
    }
}

/// A bundle of messages, to be acted on at once.
pub(super) fn bundle(messages: &[Message]) -> Vec<u8> {
    let mut bytes = Vec::new();
    put_text(BUNDLE, &mut bytes);
    bytes.extend(AT_ONCE.to_be_bytes());
    for message in messages {
        let message = message.encode();
        // No text is that long.
        let length = i32::try_from(message.len()).unwrap_or(0);
        bytes.extend(length.to_be_bytes());
        bytes.extend(message);
    }
    bytes
}

/// The messages of a packet, and of the bundles in it.
///
/// # Errors
/// The reason why a part of it cannot be read.
pub(super) fn messages(packet: &[u8]) -> Result<Vec<Message>, &'static str> {
    let mut rest = Rest(packet);
    let address = rest.text().ok_or(MALFORMED)?;
    if address != BUNDLE {
        return Ok(vec![rest.message(address)?]);
    }
    rest.bytes::<8>().ok_or(MALFORMED)?;
    let mut all = Vec::new();
    while !rest.0.is_empty() {
        let length = rest.bytes().map(i32::from_be_bytes).ok_or(MALFORMED)?;
        let length = usize::try_from(length).map_err(|_| MALFORMED)?;
        let (inner, after) = rest.0.split_at_checked(length).ok_or(MALFORMED)?;
        all.extend(messages(inner)?);
        rest = Rest(after);
    }
    Ok(all)
}

/// What is still to be read of a packet.
struct Rest<'a>(&'a [u8]);

impl Rest<'_> {
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    /// So many bytes, and those that fill them up.
    fn filled(&mut self, length: usize) -> Option<&[u8]> {
        let (bytes, rest) = self
            .0
            .split_at_checked(length.checked_next_multiple_of(4)?)?;
        self.0 = rest;
        bytes.get(..length)
    }

    fn text(&mut self) -> Option<String> {
        let length = self.0.iter().position(|&byte| byte == 0)?;
        // With its 0 byte.
        let bytes = self.filled(length + 1)?;
        String::from_utf8(bytes.get(..length)?.to_owned()).ok()
    }

    /// The message of an address, which has been read. Without arguments, their types may be missing.
    fn message(&mut self, address: String) -> Result<Message, &'static str> {
        if !address.starts_with('/') {
            return Err(MALFORMED);
        }
        let types = match self.0.is_empty() {
            true => Some(",".to_owned()),
            false => self.text(),
        };
        let types = types.ok_or(UNTYPED)?;
        let letters = types.strip_prefix(',').ok_or(UNTYPED)?.chars();
        let arguments: Option<Vec<_>> = letters.map(|letter| self.argument(letter)).collect();
        let arguments = arguments.ok_or(MALFORMED)?;
        Ok(Message { address, arguments })
    }

    fn argument(&mut self, letter: char) -> Option<Argument> {
        Some(match letter {
            'i' => Argument::Int(i32::from_be_bytes(self.bytes()?)),
            'f' => Argument::Float(f32::from_be_bytes(self.bytes()?)),
            's' => Argument::Text(self.text()?),
            'h' => Argument::Long(i64::from_be_bytes(self.bytes()?)),
            'd' => Argument::Double(f64::from_be_bytes(self.bytes()?)),
            'T' => Argument::Truth(true),
            'F' => Argument::Truth(false),
            'S' => self.text().map(|_| Argument::Other(letter))?,
            'c' | 'r' | 'm' => self.bytes::<4>().map(|_| Argument::Other(letter))?,
            't' => self.bytes::<8>().map(|_| Argument::Other(letter))?,
            'b' => {
                let length = usize::try_from(i32::from_be_bytes(self.bytes()?)).ok()?;
                self.filled(length).map(|_| Argument::Other(letter))?
            }
            'N' | 'I' | '[' | ']' => Argument::Other(letter),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(address: &str, arguments: &[Argument]) -> Message {
        Message {
            address: address.to_owned(),
            arguments: arguments.to_vec(),
        }
    }

    /// The two examples of the specification.
    #[test]
    fn messages_are_those_of_the_specification() {
        let one = message("/oscillator/4/frequency", &[Argument::Float(440.0)]);
        assert_eq!(one.encode(), b"/oscillator/4/frequency\0,f\0\0\x43\xDC\0\0");
        let other = [
            Argument::Int(1000),
            Argument::Int(-1),
            Argument::Text("hello".to_owned()),
            Argument::Float(1.234),
            Argument::Float(5.678),
        ];
        assert_eq!(
            message("/foo", &other).encode(),
            b"/foo\0\0\0\0,iisff\0\0\0\0\x03\xE8\xFF\xFF\xFF\xFFhello\0\0\0\x3F\x9D\xF3\xB6\x40\xB5\xB2\x2D"
        );
    }

    #[test]
    fn a_bundle_comes_back() {
        let all = [
            message("/a", &[Argument::Int(1), Argument::Text(String::new())]),
            message("/b", &[]),
        ];
        let bytes = bundle(&all);
        assert_eq!(messages(&bytes).as_deref(), Ok(&all[..]));
        for cut in 1..bytes.len() {
            // Only a bundle without its last messages is whole.
            let Ok(some) = messages(&bytes[..cut]) else {
                continue;
            };
            assert!(all.starts_with(&some) && some.len() < all.len(), "{cut}");
        }
    }

    #[test]
    fn numbers_have_any_type() {
        let packet = b"/x\0\0,hdifTFs\0\0\0\0\0\0\0\0\0\0\0\x02\x3F\xF8\0\0\0\0\0\0\0\0\0\x03\x3F\x80\0\0a\0\0\0";
        let found = messages(packet).expect("a message");
        let numbers: Vec<_> = found[0].arguments.iter().map(Argument::number).collect();
        let expected = [2.0, 1.5, 3.0, 1.0, 1.0, 0.0].map(Some);
        assert_eq!(numbers, [&expected[..], &[None]].concat());
        assert_eq!(found[0].types(), "hdifTFs");
    }

    #[test]
    fn arguments_of_other_types_are_passed_over() {
        let packet = b"/x\0\0,tbNf\0\0\0\0\0\0\0\0\0\0\x01\0\0\0\x03abc\0\x3F\x80\0\0";
        let found = messages(packet).expect("a message");
        let expected = [
            Argument::Other('t'),
            Argument::Other('b'),
            Argument::Other('N'),
            Argument::Float(1.0),
        ];
        assert_eq!(found, [message("/x", &expected)]);
    }
}
