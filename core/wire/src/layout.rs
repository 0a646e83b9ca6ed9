//! How the fields of a message are listed: once, for both directions.

/// Values with a table `ALL` of at most 255 entries: the index in it, one byte.
macro_rules! codes {
    ($($name:ty)+) => {$(
        impl $crate::field::Field for $name {
            const BYTES: usize = 1;
            fn put(&self, sink: &mut impl $crate::field::Sink) {
                sink.put(&[$crate::field::code_of(&Self::ALL, self)]);
            }
            fn get(
                fields: &mut $crate::field::Fields<'_>,
            ) -> Result<Self, $crate::fault::FaultKind> {
                let [code] = fields.take();
                $crate::field::entry_of(&Self::ALL, code)
            }
        }
    )+};
}

/// An enum whose variants have names, and codes in their order.
macro_rules! coded {
    (
        $(#[$about:meta])*
        pub enum $name:ident { $($(#[$doc:meta])* $variant:ident = $text:literal,)+ }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name { $($(#[$doc])* $variant,)+ }

        impl $name {
            /// All, in the order of their codes.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$variant),+];

            /// The name in a report or a log.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $text,)+ }
            }
        }

        $crate::layout::codes!($name);
    };
}

/// A struct: its fields in the order in which they are listed. Those after a semicolon are not sent, and have this value when received. `if`
/// says what must hold of one that was received.
macro_rules! layout {
    (
        $name:ty { $($field:ident: $type:ty),+ $(; $other:ident = $value:expr)? }
        $(if $valid:expr)?
    ) => {
        impl $crate::field::Field for $name {
            const BYTES: usize = 0 $(+ <$type as $crate::field::Field>::BYTES)+;
            fn put(&self, sink: &mut impl $crate::field::Sink) {
                $($crate::field::Field::put(&self.$field, sink);)+
            }
            fn get(
                fields: &mut $crate::field::Fields<'_>,
            ) -> Result<Self, $crate::fault::FaultKind> {
                let value = Self {
                    $($field: fields.get()?,)+
                    $($other: $value,)?
                };
                $(
                    let valid: fn(&Self) -> bool = $valid;
                    $crate::field::require(valid(&value), $crate::fault::FaultKind::Value)?;
                )?
                Ok(value)
            }
        }
    };
}
pub(crate) use {coded, codes, layout};
