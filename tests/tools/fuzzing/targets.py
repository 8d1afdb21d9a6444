"""All that is fuzzed."""

from fuzzing import (
    card_logs,
    commands,
    conversions,
    drawings,
    editors,
    makings,
    programs,
    readers,
    runs,
    setups,
    stores,
)
from fuzzing.target import Target

TARGETS = {
    target.name: target
    for target in (
        Target("read", readers.make, readers.judge, 100.0, most_mb=200.0),
        Target("program", programs.make, programs.judge, 12.0),
        Target("fix", programs.make, programs.judge_fix, 5.0),
        Target("iso", programs.make_iso, programs.judge, 8.0),
        Target("pmac", programs.make_pmac, programs.judge, 4.0),
        Target("iso-fix", programs.make_iso, programs.judge_fix, 5.0),
        Target("convert", conversions.make, conversions.judge, 2.0, most_s=10.0),
        Target("scenario", setups.make_scenario, setups.judge_scenario, 20.0),
        Target("machine", setups.make_machine, setups.judge_machine, 20.0),
        Target("settings", setups.make_settings, setups.judge_settings, 5.0),
        Target("baseline", setups.make_baseline, setups.judge_baseline, 2.0),
        Target("dialect", stores.make_dialect, stores.judge_dialect, 4.0),
        Target("trace", stores.make_trace, stores.judge_trace, 4.0),
        Target("loop", stores.make_loop, stores.judge_loop, 4.0),
        Target("results", stores.make_results, stores.judge_results, 2.0),
        Target("editor", editors.make, editors.judge, 8.0),
        Target("card", card_logs.make, card_logs.judge, 25.0),
        Target("dxf", drawings.make, drawings.judge, 10.0, most_s=15.0),
        Target("compare", drawings.make, drawings.judge_compared, 0.3, most_s=20.0),
        Target("make", makings.make, makings.judge, 0.3, most_s=20.0, most_mb=800.0),
        Target("command", commands.make, commands.judge, 4.0, most_s=20.0, most_mb=800.0),
        Target("run", runs.make, runs.judge, 0.2, most_s=20.0, most_mb=800.0),
        Target("iso-run", runs.make_iso, runs.judge, 0.2, most_s=20.0, most_mb=800.0),
    )
}
"""Targets by their names."""
