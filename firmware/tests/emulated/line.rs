//! Bad lines and bad clients: silence, floods, damaged bytes, commands in mid-contact.
