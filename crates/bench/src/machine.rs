//! Description of the machine.

/// Returns processor, number of cores and operating system.
pub(crate) fn words() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (system, kind) = (std::env::consts::OS, std::env::consts::ARCH);
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| processor(&text));
    let processor = processor.unwrap_or_else(|| format!("a processor of the kind {kind}"));
    let plural = if cores == 1 { "" } else { "s" };
    format!("{processor}, {cores} core{plural}, {system} {kind}")
}

/// Returns the name of the processor in `/proc/cpuinfo`.
fn processor(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let name = line.split_once(':')?.1.split_whitespace().collect::<Vec<_>>().join(" ");
    (!name.is_empty()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::processor;

    #[test]
    fn the_processor_is_named() {
        let text = "processor\t: 0\nmodel name\t: Example CPU  @ 2.00GHz\nflags\t: fpu\n";
        assert_eq!(processor(text).unwrap(), "Example CPU @ 2.00GHz");
        assert_eq!(processor("model name\t:  \n"), None);
    }
}
