//! Report for CI services in JUnit format, with one test case per scenario.

use std::fmt::Write;

/// Returns JUnit XML for names with optional failure messages.
pub(super) fn suite(cases: &[(&str, Option<String>)]) -> String {
    let failures = cases.iter().filter(|(_, failure)| failure.is_some()).count();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"golden\" tests=\"{}\" failures=\"{failures}\">\n",
        cases.len()
    );
    for (name, failure) in cases {
        let name = escaped(name);
        // Writing to a string cannot fail.
        let _ = match failure {
            None => writeln!(text, "<testcase classname=\"golden\" name=\"{name}\"/>"),
            Some(failure) => {
                let failure = escaped(failure);
                writeln!(
                    text,
                    "<testcase classname=\"golden\" name=\"{name}\"><failure message=\"{failure}\"/></testcase>"
                )
            }
        };
    }
    text + "</testsuite>\n</testsuites>\n"
}

/// Escapes characters that XML reserves and replaces those that it does not allow.
fn escaped(text: &str) -> String {
    text.chars().fold(String::new(), |mut text, c| {
        match c {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            '\n' | '\t' => text.push(' '),
            c if c.is_control() => text.push('\u{fffd}'),
            c => text.push(c),
        }
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_xml_reserves_is_spelled_out() {
        let text = suite(&[("a&b", None), ("c", Some("x < \"y\"\nz".to_owned()))]);
        assert!(text.contains("tests=\"2\" failures=\"1\"") && text.contains("name=\"a&amp;b\"/>"), "{text}");
        assert!(text.contains("<failure message=\"x &lt; &quot;y&quot; z\"/>"), "{text}");
    }
}
