"""What the quiz says about blocks, in both languages."""

from collections.abc import Mapping

from sim.setup.quiz import Said

_SAID: Mapping[str, Said] = {
    "quadrant.line": Said("Into which quadrant does block {block} run?", "第 {block} 条程序段走向第几象限？"),
    "quadrant.line.why": Said(
        "It goes by {by_x} µm in X and {by_y} µm in Y: {label}. Along an axis +X is L1, +Y L2, −X L3, −Y L4.",
        "X 方向走 {by_x} µm，Y 方向走 {by_y} µm：{label}。沿坐标轴时，+X 为 L1，+Y 为 L2，−X 为 L3，−Y 为 L4。",
    ),
    "quadrant.arc": Said(
        "Which quadrant does the first step of block {block} enter?", "第 {block} 条程序段的第一步进入第几象限？"
    ),
    "quadrant.arc.why": Said(
        "From the centre it starts at ({from_x}, {from_y}) µm and turns {turn}: {label}.",
        "以圆心为原点，起点在 ({from_x}, {from_y}) µm，{turn}走：{label}。",
    ),
    "count_axis": Said(
        "On which axis does block {block} count (G)?", "第 {block} 条程序段按哪个方向计数（计数方向 G）？"
    ),
    "count_axis.line.why": Said(
        "|X| is {wide} µm and |Y| is {high} µm: the longer one is counted.",
        "|X| = {wide} µm，|Y| = {high} µm：取较长的方向计数。",
    ),
    "count_axis.diagonal.why": Said(
        "At 45° it is GY in quadrants 1 and 3, GX in 2 and 4.", "45° 时，第一、三象限取 GY，第二、四象限取 GX。"
    ),
    "count_axis.arc.why": Said(
        "From the centre it ends at ({to_x}, {to_y}) µm, nearer the {near} axis: the other one is counted.",
        "以圆心为原点，终点在 ({to_x}, {to_y}) µm，靠近 {near} 轴：取另一个方向计数。",
    ),
    "count_axis.either.why": Said(
        "It ends as far from one axis as from the other: either may be counted, and the block says G{axis}.",
        "终点到两轴的距离相等：两个方向都可以计数，程序段写的是 G{axis}。",
    ),
    "count_axis.written.why": Said(
        "The block says G{axis}, though the rule would have it count on the other axis.",
        "程序段写的是 G{axis}，而按规则应取另一个方向计数。",
    ),
    "turn": Said("Which way does block {block} turn?", "第 {block} 条程序段的圆弧往哪个方向走？"),
    "turn.answer": Said("{turn} ({word})", "{turn}（{word}）"),
    "turn.why": Said(
        "It is written {label}: SR turns clockwise, NR counter-clockwise.",
        "程序段写的是 {label}：SR 为顺圆，NR 为逆圆。",
    ),
    "clockwise": Said("clockwise", "顺时针"),
    "counter-clockwise": Said("counter-clockwise", "逆时针"),
    "count_length": Said(
        "After how many steps in {axis} does block {block} end (J)?",
        "第 {block} 条程序段在 {axis} 方向走多少步后结束（计数长度 J）？",
    ),
    "count_length.line.why": Said(
        "J is {count}: the steps in {axis} alone are counted, and the last of them ends the block.",
        "J = {count}：只数 {axis} 方向的步数，数完程序段就结束。",
    ),
    "count_length.arc.why": Said(
        "J is {count}: the steps in {axis} alone are counted, in all quadrants that the arc passes, and the last of "
        "them ends the block.",
        "J = {count}：只数 {axis} 方向的步数，经过的各象限累加，数完程序段就结束。",
    ),
    "next_step": Said("Which way does the first step of block {block} go?", "第 {block} 条程序段的第一步往哪走？"),
    "next_step.line.why": Said(
        "F = 0 at the start, and F ≥ 0 steps the first axis, X in L1 and L3, Y in L2 and L4: {way}.",
        "起点处 F = 0，F ≥ 0 时走第一轴（L1、L3 为 X，L2、L4 为 Y）：{way}。",
    ),
    "next_step.arc.why": Said(
        "F = 0 at the start, and F ≥ 0 steps toward the centre: {way} in {label}.",
        "起点处 F = 0，F ≥ 0 时向圆心走一步：{label} 为 {way}。",
    ),
    "end": Said("Where does block {block} end?", "第 {block} 条程序段的终点在哪里？"),
    "end.place": Said("X {x} mm, Y {y} mm", "X {x} mm，Y {y} mm"),
    "end.line.why": Said(
        "It starts at X {start_x} mm, Y {start_y} mm and goes by {by_x} µm in X and {by_y} µm in Y.",
        "起点 X {start_x} mm，Y {start_y} mm；X 方向走 {by_x} µm，Y 方向走 {by_y} µm。",
    ),
    "end.arc.why": Said(
        "It turns {turn} about X {center_x} mm, Y {center_y} mm until {count} µm are counted in {axis}.",
        "绕 X {center_x} mm，Y {center_y} mm {turn}走，直到 {axis} 方向数满 {count} µm。",
    ),
}


def said(key: str, /, **values: object) -> Said:
    """Text of a key in both languages, its places filled; a value may itself be a text in both."""
    template = _SAID[key]
    return Said(*(_filled(text, at, values) for at, text in enumerate(template)))


def _filled(text: str, at: int, values: Mapping[str, object]) -> str:
    return text.format(**{name: value[at] if isinstance(value, Said) else value for name, value in values.items()})


def alike(text: str) -> Said:
    """A text that is the same in both languages."""
    return Said(text, text)
