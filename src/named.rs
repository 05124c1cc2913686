//! Enums whose values have names: the same on the command line, in files and in results.

use crate::error::Error;

/// Implements `ALL`, `name`, `Display` and `FromStr` for an enum, such as
/// `named!(Side: Left => "left", Right => "right")`.
macro_rules! named {
    ($type:ident: $($(#[$cfg:meta])* $variant:ident $(($inner:path))? => $name:literal),+ $(,)?) => {
        impl $type {
            /// All values, in the order in which help and reports list them.
            pub const ALL: [$type; [$($(#[$cfg])* $name),+].len()] =
                [$($(#[$cfg])* $type::$variant $(($inner))?),+];

            /// The name on the command line, in files and in results.
            pub const fn name(self) -> &'static str {
                match self {
                    $($(#[$cfg])* $type::$variant $(($inner))? => $name),+
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::error::Error;

            fn from_str(name: &str) -> Result<$type, $crate::error::Error> {
                let mut values = $type::ALL.into_iter();
                let known = || $crate::named::unknown_name(name, &$type::ALL.map($type::name));
                values.find(|value| value.name() == name).ok_or_else(known)
            }
        }
    };
}

pub(crate) use named;

/// The error that `name` is none of the `known` ones.
pub(crate) fn unknown_name(name: &str, known: &[&str]) -> Error {
    let known = known.join(", ");
    Error::usage(format!("unknown `{name}`: expected one of {known}"))
}

#[cfg(test)]
mod tests {
    use crate::bench::Kernel;
    use crate::film::{Aov, ChannelName, View};

    #[test]
    fn names_are_read_as_they_are_written() {
        assert_eq!(
            Kernel::ALL.map(|kernel| kernel.to_string().parse()),
            Kernel::ALL.map(Ok)
        );
        assert_eq!(Aov::ALL.map(|aov| aov.name().parse()), Aov::ALL.map(Ok));
        let channels = ChannelName::ALL;
        assert_eq!(
            channels.map(|channel| channel.name().parse()),
            channels.map(Ok)
        );
        assert_eq!(format!("{:>6}", View::Hit), "   hit");
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = "Hit".parse::<View>().unwrap_err().to_string();
        let known = View::ALL.map(View::name).join(", ");
        assert!(known.starts_with("depth, "));
        assert_eq!(error, format!("unknown `Hit`: expected one of {known}"));
    }
}
