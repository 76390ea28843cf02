#!/usr/bin/python3
"""Parts of `hdem plot` that need no run: its options, ranges of colours, curves of energies, trials of hdem fos.

    plot_parts_test.py TOOLS    the folder of plot.py

Exit code 77 (skipped) without h5py or matplotlib.
"""
import contextlib
import io
import sys
import types
import unittest
from pathlib import Path

try:
    import numpy as np
    import matplotlib    # noqa: F401
    import h5py    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.path.insert(0, str(Path(sys.argv[1]).resolve()))
import hdem_io    # noqa: E402
import plot       # noqa: E402
import plot_history    # noqa: E402


class Words(unittest.TestCase):
    def refused(self, *arguments):
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit) as left:
            plot.parse(list(arguments))
        self.assertEqual(left.exception.code, 2)
        self.assertEqual(said.getvalue().count("\n"), 1, said.getvalue())
        return said.getvalue()

    def test_without_effect_are_refused_with_the_remedy(self):
        frame = "run/frames/blocks_000003.hdf"
        of_frames = (["--frame", "1"], ["--contacts"], ["--range", "0", "1"], ["--window", "0", "0", "1", "1"], ["--colour", "stress"], ["--excavation"], ["--joints", "slip"],
                     ["--bolts"], ["--liners", "thrust"], ["--crosses"])
        for instead in (["--history", "ball"], ["--energy"], ["--factor"]):
            for words in of_frames:
                self.assertIn(f"argument {words[0]}: of pictures of a frame. Leave it out, or leave out {instead[0]}.", self.refused("run", *instead, *words))
        for words in (["--history", "ball"], ["--energy"], ["--factor"], ["--frame", "3"], ["--frame", "last"], ["--contacts"], ["--joints", "slip"], ["--bolts"], ["--liners", "thrust"]):
            self.assertIn(f"argument {words[0]}: blocks_000003.hdf is a single frame. Give the run's folder or its results.h5", self.refused(frame, *words))
        self.assertIn("argument --energy: another picture than --history", self.refused("run", "--history", "ball", "--energy"))
        self.assertIn("argument --window: another part than --excavation", self.refused("run", "--excavation", "--window", "0", "0", "1", "1"))
        self.assertIn("argument --range: --colour regime has none", self.refused("run", "--colour", "regime", "--range", "0", "1"))
        self.assertIn("argument --numbers: needs --joints", self.refused("run", "--numbers"))

    def test_that_are_left_out_have_their_defaults(self):
        for arguments in (["run"], ["run", "--history", "ball"], ["run/frames/blocks_000003.hdf"]):
            options = plot.parse(arguments)
            self.assertEqual((options.colour, options.frame), ("displacement", "last"))


class Energies(unittest.TestCase):
    """A table as a run has it, with curves of both signs, one that is nothing, and a history of the same name."""

    def setUp(self):
        time = np.linspace(0.0, 1.0, 5)
        columns = {f"term_{i}": (-1.0)**i * 10.0**(i - 8) * time for i in range(12)} | {"nothing": 0.0 * time}
        self.table = hdem_io.Table({"cycle": np.arange(5), "time": time, **columns}, {name: "J" for name in columns} | {"time": "s", "cycle": "1"})
        own = hdem_io.Table({"cycle": np.arange(5), "time": time, "speed": time}, {"time": "s", "cycle": "1", "speed": "m/s"})
        self.run_ = types.SimpleNamespace(histories=["energy"], energy=lambda: self.table, history=lambda name: own, state=lambda: "done")

    def drawn(self, *arguments):
        figure = plot_history.draw_history(self.run_, plot.parse(["run", *arguments]))
        self.addCleanup(plot.plt.close, figure)
        figure.canvas.draw()
        return figure.axes[0]

    def test_of_both_signs_are_all_seen(self):
        axes = self.drawn("--energy")
        for line in axes.lines:
            values = line.get_ydata()
            self.assertTrue(np.all(np.isfinite(values)), line.get_label())
            self.assertTrue(np.all(np.isfinite(axes.transData.transform(line.get_xydata()))), line.get_label())
        self.assertEqual([line.get_label() for line in axes.lines], [f"term {i}" for i in range(12)])
        low, high = axes.get_ylim()
        self.assertTrue(low < -1000.0 and high > 100.0, (low, high))

    def test_each_curve_has_a_look_of_its_own_and_nothing_is_named(self):
        axes = self.drawn("--energy")
        self.assertEqual(len({(line.get_color(), line.get_linestyle()) for line in axes.lines}), 12)
        self.assertEqual(axes.get_title(loc="left"), "energies\nalways 0: nothing")

    def test_history_of_that_name_is_drawn_and_energies_too(self):
        self.assertEqual([line.get_label() for line in self.drawn("--history", "energy").lines], ["speed"])
        self.run_.histories = []
        self.assertEqual(len(self.drawn("--history", "energy").lines), 12)

    def test_without_negative_ones_stay_logarithmic(self):
        for name in self.table:
            self.table[name] = np.abs(self.table[name])
        self.assertEqual(self.drawn("--energy").get_yscale(), "log")


class Factor(unittest.TestCase):
    def test_each_verdict_has_its_word_and_its_marker(self):
        """An undecided trial does not fail."""
        trial = {"search": "as_given", "reason": "", "displacement": 1e-3, "cycles": 10, "failing_blocks": []}
        trials = [trial | {"factor": factor, "verdict": verdict} for factor, verdict in ((1.0, "stable"), (1.1, "undecided"), (1.2, "failed"))]
        run = types.SimpleNamespace(folder="run", summary=lambda: {"factor_of_safety": {"trials": trials}})
        figure = plot.draw_factor(run, plot.parse(["run", "--factor", "--title", ""]))
        self.addCleanup(plot.plt.close, figure)
        found = {line.get_label(): (list(line.get_xdata()), line.get_fillstyle(), line.get_markerfacecolor()) for line in figure.axes[0].lines if line.get_marker() != "None"}
        self.assertEqual(found, {"strength as given: stands": ([1.0], "full", "#0072b2"), "strength as given: fails": ([1.2], "full", "white"),
                                 "strength as given: undecided": ([1.1], "left", "#0072b2")})


class Positions(unittest.TestCase):
    """A block at 20.5 m that moves by a millimetre: an axis from 20.5 to 20.501 cannot be read."""

    def test_that_change_little_are_drawn_from_their_first_value(self):
        self.assertEqual(plot_history.start_of("position_x", np.array([20.5, 20.501, np.nan])), 20.5)
        self.assertEqual(plot_history.start_of("position_x", np.array([20.5, 23.0])), 0.0)
        self.assertEqual(plot_history.start_of("position_x", np.array([0.0, 1e-3])), 0.0)
        self.assertEqual(plot_history.start_of("force_x", np.array([20.5, 20.501])), 0.0)
        self.assertEqual(plot_history.start_of("position_x", np.array([np.nan])), 0.0)


class ColourRange(unittest.TestCase):
    def test_greatest_value_is_the_end(self):
        self.assertEqual(plot.colour_range(np.array([0.0, 1.0, 2.0]), False), (0.0, 2.0, "neither"))
        self.assertEqual(plot.colour_range(np.array([-3.0, 1.0]), True), (-3.0, 3.0, "neither"))

    def test_few_far_values_do_not_wash_out_the_rest(self):
        low, high, extend = plot.colour_range(np.append(np.linspace(0.0, 1e-3, 500), 0.09), False)
        self.assertLess(high, 1.1e-3)
        self.assertEqual((low, extend), (0.0, "max"))

    def test_nothing_moves(self):
        self.assertEqual(plot.colour_range(np.zeros(4), False), (0.0, 1.0, "neither"))

    def test_units_read_well(self):
        self.assertEqual(plot.scaled_unit("m", 0.02), (1e-3, "mm"))
        self.assertEqual(plot.scaled_unit("Pa", 2e6), (1e6, "MPa"))
        self.assertEqual(plot.scaled_unit("deg", 0.1), (1, "deg"))
        self.assertEqual(plot.scaled_unit("m", 0.0), (1e-6, "µm"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
