//! Packets of Open Sound Control 1.0: messages with an address and arguments, alone or in bundles, to bytes and back.
//!
//! All numbers are big-endian. A text ends with a 0 byte and is filled up with more to a multiple of 4. A message is its address, a text of
//! a comma and a letter for each argument, and the arguments. A bundle is the text `#bundle`, a time of 8 bytes, and packets, each after its
//! length.

/// The start of a bundle.
const BUNDLE: &str = "#bundle";
/// The time of a bundle: at once.
const AT_ONCE: u64 = 1;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Argument {
    Int(i32),
    Float(f32),
    Text(String),
    /// Of another type.
    Other,
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
    fn encode(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        put_text(&self.address, &mut bytes);
        let letters = self.arguments.iter().filter_map(|argument| match argument {
            Argument::Int(_) => Some('i'),
            Argument::Float(_) => Some('f'),
            Argument::Text(_) => Some('s'),
            Argument::Other => None,
        });
        put_text(&format!(",{}", letters.collect::<String>()), &mut bytes);
        for argument in &self.arguments {
            match argument {
                Argument::Int(value) => bytes.extend(value.to_be_bytes()),
                Argument::Float(value) => bytes.extend(value.to_be_bytes()),
                Argument::Text(text) => put_text(text, &mut bytes),
                Argument::Other => {}
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

/// The messages of a packet, and of the bundles in it; `None` if a part of it is malformed.
pub(super) fn messages(packet: &[u8]) -> Option<Vec<Message>> {
    let mut rest = Rest(packet);
    let address = rest.text()?;
    if address != BUNDLE {
        return Some(vec![rest.message(address)?]);
    }
    rest.bytes::<8>()?;
    let mut all = Vec::new();
    while !rest.0.is_empty() {
        let length = usize::try_from(i32::from_be_bytes(rest.bytes()?)).ok()?;
        let (inner, after) = rest.0.split_at_checked(length)?;
        all.extend(messages(inner)?);
        rest = Rest(after);
    }
    Some(all)
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
    fn message(&mut self, address: String) -> Option<Message> {
        let types = match self.0.is_empty() {
            true => ",".to_owned(),
            false => self.text()?,
        };
        let letters = types.strip_prefix(',')?.chars();
        let arguments: Option<Vec<_>> = letters.map(|letter| self.argument(letter)).collect();
        let arguments = arguments?;
        address
            .starts_with('/')
            .then_some(Message { address, arguments })
    }

    fn argument(&mut self, letter: char) -> Option<Argument> {
        Some(match letter {
            'i' => Argument::Int(i32::from_be_bytes(self.bytes()?)),
            'f' => Argument::Float(f32::from_be_bytes(self.bytes()?)),
            's' => Argument::Text(self.text()?),
            'S' => self.text().map(|_| Argument::Other)?,
            'c' | 'r' | 'm' => self.bytes::<4>().map(|_| Argument::Other)?,
            'h' | 'd' | 't' => self.bytes::<8>().map(|_| Argument::Other)?,
            'b' => {
                let length = usize::try_from(i32::from_be_bytes(self.bytes()?)).ok()?;
                self.filled(length).map(|_| Argument::Other)?
            }
            'T' | 'F' | 'N' | 'I' | '[' | ']' => Argument::Other,
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
        assert_eq!(messages(&bytes).as_deref(), Some(&all[..]));
        for cut in 1..bytes.len() {
            // Only a bundle without its last messages is whole.
            let Some(some) = messages(&bytes[..cut]) else {
                continue;
            };
            assert!(all.starts_with(&some) && some.len() < all.len(), "{cut}");
        }
    }

    #[test]
    fn arguments_of_other_types_are_passed_over() {
        let packet =
            b"/x\0\0,hbTfd\0\0\0\0\0\0\0\0\0\x01\0\0\0\x03abc\0\x3F\x80\0\0\0\0\0\0\0\0\0\0";
        let found = messages(packet).expect("a message");
        let other = Argument::Other;
        let expected = [
            other.clone(),
            other.clone(),
            other.clone(),
            Argument::Float(1.0),
            other,
        ];
        assert_eq!(found, [message("/x", &expected)]);
    }
}
