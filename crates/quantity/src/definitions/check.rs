//! What `stickslip check --json` says, and what the pages of `stickslip-lab validate` are headed by.

use super::Definition;

const fn of(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "check --json", name, text }
}

const fn page(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "validate", name, text }
}

pub(super) const CHECK: &[Definition] = &[
    of("file", "the file as it was named"),
    of("ok", "whether a run would take it"),
    of("error", "the first of `errors`, with the same keys"),
    of(
        "errors.table",
        "the table that line and column count in, where one that the scenario names is to blame",
    ),
    of("errors.override", "the argument of --set that line and column count in, where one is to blame"),
    of("errors.line", "line, from 1"),
    of("errors.column", "column in characters, from 1"),
    of("errors.width", "characters that are to blame"),
    of("errors.path", "key path such as `contacts.ball.friction`; empty for the file as a whole"),
    of("errors.message", "what was expected and what came"),
    of("errors.help", "what to try"),
    of("more", "`true` where more is known to be wrong than the twenty that are told"),
    of(
        "unjudged",
        "what was not judged, or not all of it, because of the errors: `form` (keys, units, ranges), `meaning` (what parts are to each other), `equilibrium` (whether there is one to start from), `limits` (rows, lines and memory of a run); more may be wrong there",
    ),
    of("warnings.kind", "what is odd, one word for machines; the other keys are those of `errors`"),
    page("deviation", "what is held against what is known, in the words of its page"),
    page("asked: at most", "the largest deviation that counts as kept"),
    page(
        "found",
        "the largest, or the root of the mean square where it says rms, of what the program computes",
    ),
    page("page", "link to the page, with set-up, numbers and limits"),
    page("reference", "what it is held against: measurement, another program or closed form"),
    page("case", "which of the cases of the page"),
    page("program", "what this program computes"),
    page("known", "the reference's value"),
    page("formula", "the closed form's value"),
    page("off by", "how far the program's value lies from that, as a share where a % stands"),
];
