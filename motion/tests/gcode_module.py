"""Canonical calls of LinuxCNC's `gcode` module for every *.ngc of a folder: a file *.calls each, a row a call, numbers at full precision.

Arguments: the folder. The last row of a file is `end` if the program ended well.
"""

import os
import pathlib
import sys

import gcode

WANTED = {
    "straight_traverse", "straight_feed", "straight_probe", "arc_feed", "rigid_tap", "set_feed_rate", "dwell",
    "set_g5x_offset", "set_g92_offset", "set_xy_rotation",
}


class Canon:
    """Takes the calls; answers what the interpreter asks."""

    def __init__(self, folder):
        self.rows = []
        self.parameter_file = str(folder / "module.var")
        self.tools = {}
        for index, row in enumerate((folder / "tool.tbl").read_text().splitlines(), 1):
            words = {word[0]: float(word[1:]) for word in row.split(";")[0].split()}
            offsets = tuple(words.get(axis, 0.0) for axis in "XYZABCUVW")
            cutter = tuple(words.get(word, 0.0) for word in "DIJ")
            self.tools[index] = (int(words["T"]),) + offsets + cutter + (int(words.get("Q", 0)),)

    def __getattr__(self, name):
        def call(*values):
            if name in WANTED:
                self.rows.append(" ".join([name] + [repr(float(v)) for v in values]))
        return call

    def get_external_angular_units(self):
        return 1.0

    def get_external_length_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0x1FF

    def get_block_delete(self):
        return 0

    def get_tool(self, pocket):
        return self.tools.get(pocket, (-1,) + (0.0,) * 12 + (0,))

    def check_abort(self):
        return False


def run(program):
    canon = Canon(program.parent)
    pathlib.Path(canon.parameter_file).write_text("")
    try:
        result, _ = gcode.parse(str(program), canon, "G21", "")
        good = result <= gcode.MIN_ERROR
    except Exception as why:  # a call that the module itself can't make
        canon.rows.append(f"# {why}")
        good = False
    program.with_suffix(".calls").write_text("\n".join(canon.rows + (["end"] if good else [])))


def main():
    for program in sorted(pathlib.Path(sys.argv[1]).glob("*.ngc")):
        child = os.fork()  # the module keeps state between programs, and some programs crash it
        if child == 0:
            run(program)
            os._exit(0)
        os.waitpid(child, 0)


main()
