"""Plans for tests, none of which goes unchecked."""

from lawful import assert_plan_is_lawful

from controller.motion.limits import Feeds, MotionLimits, row_limits
from controller.motion.plan import Plan
from controller.motion.planner import plan_rows
from parser.toolpath import Toolpath


def plan_toolpath(toolpath: Toolpath, feeds: Feeds, limits: MotionLimits) -> Plan:
    """The fastest plan of a toolpath under the limits."""
    rows = row_limits(toolpath, feeds, limits)
    plan = plan_rows(rows, jerk_um_s3=limits.jerk_um_s3)
    assert_plan_is_lawful(plan, rows, jerk_um_s3=limits.jerk_um_s3)
    return plan
