//! Distribution of the parts of a study among processes.

use super::StudyError;
use std::str::FromStr;

/// One of several processes that share a study. Shard i of n computes the parts with numbers i - 1, i - 1 + n, i - 1 + 2 n, …
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Index, from 0.
    index: u64,
    /// Number of shards.
    count: u64,
}

/// Environment variables of array jobs: task number, smallest task number and number of tasks; and the name of the scheduler.
const ARRAYS: [(&str, &str, &str, &str); 4] = [
    ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_COUNT", "Slurm"),
    ("HQ_TASK_ID", "HQ_TASK_MIN", "HQ_TASK_COUNT", "HyperQueue"),
    ("PBS_ARRAY_INDEX", "PBS_ARRAY_MIN", "PBS_ARRAY_COUNT", "PBS"),
    ("SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_COUNT", "Grid Engine"),
];

impl Shard {
    /// The single shard with all parts.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Creates shard `index` of `count`, from 0. Returns `None` if `index` is not below `count`.
    #[must_use]
    pub fn new(index: u64, count: u64) -> Option<Self> {
        (index < count).then_some(Self { index, count })
    }

    /// Returns whether the shard computes a part.
    #[must_use]
    pub fn takes(self, part: u64) -> bool {
        part % self.count == self.index
    }

    /// Returns whether the shard computes all parts.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// Returns the shard of the array job that environment variables describe.
    ///
    /// # Errors
    /// Fails if no variable describes an array job, or the number of tasks is unknown.
    pub fn from_environment(variable: &dyn Fn(&str) -> Option<String>) -> Result<Self, StudyError> {
        let refused = |text: String| StudyError::Shard(text);
        let number = |name: &str| -> Result<Option<u64>, StudyError> {
            let Some(text) = variable(name) else { return Ok(None) };
            let read = text.trim().parse();
            read.map(Some).map_err(|_| {
                refused(format!("--shard auto: expected a whole number in {name}, got \"{text}\""))
            })
        };
        for (id, least, count, engine) in ARRAYS {
            // Grid Engine sets "undefined" outside of array jobs.
            if variable(id).is_none_or(|text| text == "undefined") {
                continue;
            }
            let Some(id_value) = number(id)? else { continue };
            let first = number(least)?.unwrap_or(1);
            let of = match number(count)? {
                Some(of) => Some(of),
                // Grid Engine gives the last task number.
                None if id == "SGE_TASK_ID" => {
                    number("SGE_TASK_LAST")?.map(|last| (last + 1).saturating_sub(first))
                }
                None => None,
            };
            let Some(of) = of.filter(|of| *of > 0) else {
                return Err(refused(format!(
                    "--shard auto: {engine} sets the task number ({id}={id_value}), but not the number of tasks\n   help: set {count}, or give --shard i/n"
                )));
            };
            return Self::numbered(id_value.wrapping_sub(first).wrapping_add(1), of).ok_or_else(|| {
                refused(format!(
                    "--shard auto: task {id_value} of {engine} is not one of the {of} tasks from {first} on"
                ))
            });
        }
        let known: Vec<&str> = ARRAYS.iter().map(|(id, ..)| *id).collect();
        Err(refused(format!(
            "--shard auto: this is not an array job: none of {} is set\n   help: give --shard i/n",
            known.join(", ")
        )))
    }

    fn numbered(i: u64, count: u64) -> Option<Self> {
        Self::new(i.checked_sub(1)?, count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        parts
            .and_then(|(i, n)| Self::numbered(i, n))
            .ok_or_else(|| "expected i/n with i from 1 to n, such as 2/7, or auto".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn auto(set: &[(&str, &str)]) -> Result<Shard, String> {
        let variable =
            |name: &str| set.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned());
        Shard::from_environment(&variable).map_err(|error| error.to_string())
    }

    #[test]
    fn all_shards_together_take_every_part_once() {
        for count in [1, 2, 7] {
            let shards: Vec<Shard> = (1..=count).map(|i| format!("{i}/{count}").parse().unwrap()).collect();
            assert!((0..100).all(|part| shards.iter().filter(|shard| shard.takes(part)).count() == 1));
        }
        for text in ["0/3", "4/3", "1/0", "1", "a/b", "-1/2", ""] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn an_array_job_says_which_shard_it_is() {
        let slurm = |id, least, count| {
            auto(&[
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_MIN", least),
                ("SLURM_ARRAY_TASK_COUNT", count),
            ])
        };
        assert_eq!(slurm("3", "0", "4"), Ok("4/4".parse().unwrap()));
        assert_eq!(slurm("1", "1", "4"), Ok("1/4".parse().unwrap()));
        assert!(slurm("7", "1", "4").unwrap_err().contains("task 7 of Slurm is not one of the 4 tasks"));
        assert_eq!(
            auto(&[("SGE_TASK_ID", "2"), ("SGE_TASK_FIRST", "1"), ("SGE_TASK_LAST", "5")]),
            Ok("2/5".parse().unwrap())
        );
        assert!(auto(&[("PBS_ARRAY_INDEX", "2")]).unwrap_err().contains("PBS_ARRAY_COUNT"));
        assert!(auto(&[("SGE_TASK_ID", "undefined")]).unwrap_err().contains("not an array job"));
    }
}
