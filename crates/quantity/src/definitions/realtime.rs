//! What `realtime` tells of a loop.

use super::Definition;

const fn of(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "realtime.json", name, text }
}

pub(super) const REALTIME: &[Definition] = &[
    of("scenario", "name of the scenario"),
    of("scenario_number", "its number in packets, in hexadecimal digits"),
    of("stepper", "the stepper, in words"),
    of("period_s", "length of a frame"),
    of("frames_asked", "frames asked for"),
    of("frames", "frames computed"),
    of("simulated_s", "simulated time"),
    of("wall_s", "on the wall from the first deadline on"),
    of("paced", "whether frames waited for their deadlines"),
    of("spin_s", "how long before each deadline the loop watched the clock"),
    of(
        "overrun_policy",
        "what was done about overruns, `skip` (deadlines that had passed were left out) or `stop`; null without a clock",
    ),
    of(
        "ended",
        "how it ended: `complete`, `interrupted`, `overrun`, `silence`, `memory` (another process made the shared memory shorter), `stopped` or `no_input`",
    ),
    of("error", "why the drive stopped itself, or what became of the shared memory; null where neither was"),
    of("kept", "whether it is complete and no frame ended after the next deadline"),
    of("overruns", "frames that ended after the next deadline"),
    of("deadlines_left_out", "deadlines that had passed and were left out"),
    of("most_left_out", "most of them in a row"),
    of(
        "execution.SCALE",
        "from waking until the outputs were out: `median_us`, `p99_9_us` (999 of 1 000 were no longer), `p99_99_us`, `worst_us`, `mean_us`",
    ),
    of("latency.SCALE", "from the deadline until the loop woke, likewise; null without a clock"),
    of(
        "empty_execution.SCALE",
        "execution of an empty loop of the same period, before the start; null where none was run",
    ),
    of("empty_latency.SCALE", "wake-up latency of that loop"),
    of("empty_frames", "its frames"),
    of("inputs", "names of inputs, in the order of packets"),
    of("outputs", "names of outputs, in the order of packets"),
    of("received.good", "packets or lines that were taken, or that a later one of the same frame followed"),
    of("received.superseded", "of these, followed by another one in the same frame"),
    of("received.wrong_length", "refused: too long or too short"),
    of("received.foreign", "refused: no packet, another version, or another number of values"),
    of("received.other_scenario", "refused: another scenario's"),
    of("received.repeated", "refused: the number of the last one again"),
    of("received.out_of_order", "refused: a smaller number than the last one's"),
    of(
        "received.out_of_range",
        "refused: a value or time stamp that is not finite, or a value out of its range",
    ),
    of("received.other_client", "refused: of another client than the one that has the inputs"),
    of(
        "received.torn_frames",
        "frames in which somebody was writing into shared memory whenever it was looked at",
    ),
    of("received.stale_frames", "frames in which nothing good came"),
    of("received.most_stale", "most of them in a row"),
    of("received.owners", "clients that had the inputs, one after the other"),
    of("received.silences", "times that `--silence` came into force"),
    of("outputs_unsent", "outputs that did not go out"),
    of("log_lost", "frames for which the log had no room"),
    of("recording_lost", "frames for which the recording of inputs had no room"),
    of("denied", "what the system did not grant, in words"),
    of("probe.frames", "frames that were tried before the start, without a clock; null where none were"),
    of("probe.median_us", "half of them took no longer"),
    of("probe.p99_us", "99 of 100 took no longer"),
    of("probe.worst_us", "the longest"),
    of("rows.springs", "springs of the rows that were tried in place of the contacts; null where none were"),
    of("rows.p99_us", "99 of 100 frames on each took no longer"),
    of(
        "rows.fit_in_period",
        "springs for which a straight line through these comes to the period; null where that is not to be seen from them",
    ),
];
