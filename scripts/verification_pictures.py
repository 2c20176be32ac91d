# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Draws the pictures of verification decks, doc/pictures/verification/*.png, from their results.

The kind of picture follows from the results: the shapes of the lowest modes; the errors of a study over the size of cells; a computed history and the
exact one if a check compares a column with a formula of time; else the displaced body. LOOKS has other settings for decks that these pictures do not show
well.
"""

import csv
import dataclasses
import re
import shutil

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from fields import round_factor, with_prefix
from pictures import PICTURES, Results, add_image, cell_edges, image_of, outline, plotter, show_body, surface

FOLDER = PICTURES / "verification"
COLOURS_OF_A_FILE = 255
COMPUTED, EXACT, OTHER = "#0072b2", "#d55e00", "#009e73"
SLANTED, FROM_FRONT, FROM_ABOVE = (0.45, -1, 0.45), (0.25, -1, 0.2), (0.2, 0.25, 1)
MAY_BE_DRAWN_AS_IT_IS = 0.05  # displacements of this part of the body's size are seen without magnification


@dataclasses.dataclass
class Look:
    """How the picture of a deck is drawn."""
    quantity: str = "displacement"
    times: tuple = ()  # times of the states that are shown; if empty, the last state
    all_states: bool = False
    direction: tuple = SLANTED
    up: tuple = (0, 0, 1)
    unit: str = "m"
    plot: object = None  # a function that draws histories beside the body, or in place of it
    body: bool = True  # whether the body is drawn


def evaluate(formula, **columns):
    """The value of a formula of a parameter file. It may contain columns of a history, which are given by name."""
    functions = {name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "abs", "pi")}
    functions |= {"a" + name: getattr(np, "arc" + name) for name in ("sin", "cos", "tan")}
    return eval(formula.replace("^", "**"), {"__builtins__": {}}, functions | columns)


def exact_history(outcome):
    """The first column that a check compares with a formula of the time or of the step, as in "max abs(tip_x - FORMULA) = 0", and that formula. None if
    there is no such check."""
    for check in outcome.entry("Checks").split(";"):
        match = re.search(r"max abs\((\w+) ([-+]) ([^=]*)\)\s*=\s*0 ", check)
        if not match or not re.search(r"\b(time|step)\b", match.group(3)):
            continue
        column, sign, formula = match.groups()
        formula = formula.strip() if sign == "-" else f"-({formula.strip()})"
        try:
            evaluate(formula, time=1.0, step=1.0)
        except (NameError, SyntaxError):  # the formula has other columns, too, or the check goes on after the parenthesis
            continue
        return column, formula
    return None


def draw_exact(figure, history, column, formula):
    """Draws a computed history over the exact one, and the difference of both below."""
    exact = evaluate(formula, time=history["time"], step=history["step"])
    time, time_unit = with_prefix(history["time"].max(), "s")
    unit = "N" if column.startswith("reaction") else "m"
    factor, unit = with_prefix(np.abs(exact).max(), unit)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.plot(time * history["time"], factor * exact, color=EXACT, linewidth=4, alpha=0.4, label="exact")
    above.plot(time * history["time"], factor * history[column], color=COMPUTED, linewidth=1.2, label="computed")
    above.set_ylabel(f"{column} [{unit}]")
    above.legend(loc="upper right")
    below.plot(time * history["time"], factor * (history[column] - exact), color=COMPUTED, linewidth=0.8)
    below.set_ylabel(f"difference [{unit}]")
    below.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3))
    finish((above, below), f"time [{time_unit}]")


def finish(axes, abscissa):
    for one in axes:
        one.grid(alpha=0.3)
        one.margins(x=0)
    axes[-1].set_xlabel(abscissa)
    axes[0].figure.align_ylabels(axes)


def draw_step_load(figure, history):
    """Draws the displacement of the tip, a saw-tooth, and the stress at the root, which jumps. Numbers are those of the deck: c = 5000 m/s,
    2 p L / E = 1 mm."""
    time = 1e3 * history["time"]
    tip, root = figure.subplots(2, 1, sharex=True)
    tip.plot((0, 0.4, 0.8), (0, 1, 0), color=EXACT, linewidth=4, alpha=0.4, label="exact")
    tip.plot(time, 1e3 * history["tip_x"], color=COMPUTED, linewidth=1.2, label="computed")
    tip.set_ylabel("tip_x [mm]")
    tip.legend(loc="upper right")
    root.plot((0, 0.2, 0.2, 0.6, 0.6, 0.8), (0, 0, 200, 200, 0, 0), color=EXACT, linewidth=4, alpha=0.4)
    root.plot(time, -1e-6 * history["reaction_x"] / 4e-4, color=COMPUTED, linewidth=0.8)
    root.set_ylabel("stress at the root [MPa]")
    finish((tip, root), "time [ms]")


def draw_energies(figure, history):
    axes = figure.subplots()
    axes.plot(history["time"], history["external_work"], color=EXACT, linewidth=4, alpha=0.4, label="work of the weight")
    axes.plot(history["time"], history["kinetic_energy"], color=COMPUTED, linewidth=1.2, label="kinetic energy")
    axes.plot(history["time"], history["elastic_energy"], color=OTHER, linewidth=1.2, label="elastic energy")
    axes.set_ylabel("energy [J]")
    axes.legend()
    finish((axes,), "time [s]")


def draw_conserved(figure, history):
    """Draws the energies, and the changes of momenta and of the total energy since the start."""
    energies, drift = figure.subplots(2, 1, sharex=True)
    energies.semilogy(history["time"], history["kinetic_energy"], color=COMPUTED, label="kinetic")
    energies.semilogy(history["time"][1:], history["elastic_energy"][1:], color=OTHER, label="elastic")
    energies.set_ylabel("energy [J]")
    energies.legend(loc="lower right")
    for kind, colour in (("momentum", COMPUTED), ("angular_momentum", OTHER)):
        vectors = np.stack([history[f"{kind}_{axis}"] for axis in "xyz"])
        change = np.linalg.norm(vectors - vectors[:, :1], axis=0) / np.linalg.norm(vectors[:, 0])
        drift.semilogy(history["time"][1:], change[1:], color=colour, label=kind.replace("_", " "))
    drift.semilogy(history["time"][1:], np.abs(history["energy_balance"][1:]) / history["kinetic_energy"][0], color=EXACT, label="energy")
    drift.set_ylabel("relative change")
    drift.legend(loc="center right")
    finish((energies, drift), "time [s]")


LOOKS = {
    "bar_step_load": Look(body=False, plot=draw_step_load),
    "bend_45": Look(all_states=True, direction=(-1, -0.6, 0.6)),
    "cook": Look("von_mises", direction=FROM_ABOVE, up=(0, 1, 0), unit=""),
    "elastica": Look(all_states=True, direction=FROM_FRONT),
    "flexure": Look(direction=FROM_ABOVE, up=(0, 1, 0)),
    "lame_sphere": Look(direction=(-1, -0.8, -0.6), unit=""),
    "pendulum": Look(all_states=True, direction=FROM_FRONT, plot=draw_energies),
    "pure_bending": Look(direction=FROM_ABOVE, up=(0, 1, 0)),
    "ring": Look(times=(0.1, 0.3, 0.5, 0.75, 1), direction=FROM_FRONT),
    "rotated_body": Look(direction=(0.8, -0.7, 0.7)),
    "rotated_body_cell_centre": Look(direction=(0.8, -0.7, 0.7)),
    "spinning_bar": Look(times=(0.05, 0.1, 0.157), direction=FROM_ABOVE, up=(0, 1, 0)),
    "tumbling_block": Look(times=(0, 1, 2), direction=(0.75, 0.7, 0.25), plot=draw_conserved),
}


def magnification(grids):
    """The factor that displacements are multiplied by: 1 if they can be seen as they are, else a round number that makes them up to a tenth of the body's
    size."""
    size = grids[0].length
    largest = max(np.linalg.norm(grid["displacement"], axis=1).max() for grid in grids)
    if largest == 0 or largest >= MAY_BE_DRAWN_AS_IT_IS * size:
        return 1
    return round_factor(0.1 * size / largest)


def norm_of(mesh, quantity):
    values = mesh[quantity]
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def image_of_states(grids, look, warp, size=(1280, 900)):
    """Draws the displaced bodies in one picture, with the outline at rest. Returns the picture and the largest value of the quantity shown."""
    meshes = [surface(grid, warp) for grid in grids]
    largest = max(norm_of(mesh, look.quantity).max() for mesh in meshes)
    p = plotter(size)
    for mesh in meshes:
        mesh["shown"] = norm_of(mesh, look.quantity)
        edges = cell_edges(mesh)
        show_body(p, mesh, "shown", (0, largest or 1))
        p.add_mesh(edges, color="black", opacity=0.35, line_width=1.5)
    rest = outline(grids[0])
    if rest.n_points:
        p.add_mesh(rest, color="black", line_width=2.5)
    p.view_vector(np.array(look.direction, dtype=float), look.up)
    p.enable_parallel_projection()
    p.reset_camera()
    return image_of(p), largest


def states(run, look):
    times = run.times if look.all_states else look.times or run.times[-1:]
    return [run.state(time) for time in times]


def draw_body(figure, run, look):
    grids = states(run, look)
    warp = magnification(grids)
    image, largest = image_of_states(grids, look, warp)
    stress = look.quantity == "von_mises"
    factor, unit = with_prefix(largest, look.unit and ("Pa" if stress else look.unit))
    title = "von Mises stress" if stress else "displacement"
    title += f" [{unit}]" if unit else ""
    title += f"; displacement drawn x {warp:g}" if stress and warp != 1 else f", drawn x {warp:g}" if warp != 1 else ""
    add_image(figure, figure.subplots(), image, (0, factor * largest or 1), title)


def draw_modes(figure, run, look):
    """Draws the shapes of the modes with the lowest frequencies that are not zero, one mode of each frequency."""
    with open(run.folder / "modes.csv", newline="", encoding="utf-8") as file:
        frequencies = np.array([float(row["frequency"]) for row in csv.DictReader(file)])
    groups = []
    for mode, frequency in enumerate(frequencies, start=1):
        if groups and np.isclose(frequency, frequencies[groups[-1][0] - 1], rtol=1e-4, atol=0):
            groups[-1].append(mode)
        elif frequency > 1e-6 * frequencies[-1]:
            groups.append([mode])
    images = []
    for group in groups[:6]:
        grid = run.state(group[0])
        images.append(image_of_states([grid], look, magnification([grid]), (800, 600))[0])
    columns = columns_for(images, *figure.get_size_inches())
    places = figure.subplots(-(-len(images) // columns), columns, squeeze=False).ravel()
    for axes in places:
        axes.axis("off")
    for axes, image, group in zip(places, images, groups):
        axes.imshow(image)
        modes = f"mode{'s' if len(group) > 1 else ''} {', '.join(map(str, group))}"
        axes.set_title(f"{modes}: {frequencies[group[0] - 1]:.5g} Hz", fontsize=9)


def columns_for(images, width, height, title=0.3):
    """The number of columns in which images come out largest on a figure of the given size [inches]."""
    rows, columns = np.max([image.shape[:2] for image in images], axis=0)

    def scale(n):
        return min(width / n / columns, (height / -(-len(images) // n) - title) / rows)

    return max(range(1, len(images) + 1), key=scale)


def draw_look(figure, run, look):
    """Draws the body, histories, or both side by side, as LOOKS says."""
    if look.body and look.plot:
        figure.set_size_inches(8, 4)
        left, right = figure.subfigures(1, 2)
    else:
        left = right = figure
    if look.body:
        draw_body(left, run, look)
    if look.plot:
        look.plot(right, run.history())
    if not look.body:
        return "Computed histories, drawn over those of theory."
    several = look.all_states or len(look.times) > 1
    return f"The {'displaced body at several times' if several else 'last state'} with its cells, and the edges of the body at rest" + \
        ("; beside that, histories of the run." if look.plot else ".")


def draw_results(figure, outcome):
    """Draws the results of a simulation or of an analysis of modes; returns the caption."""
    run = Results(outcome.directory)
    look = LOOKS.get(outcome.deck.stem)
    exact = None if look else exact_history(outcome)
    if (outcome.directory / "modes.csv").exists():
        draw_modes(figure, run, look or Look())
        return "Shapes of the lowest modes, one mode for each frequency; colours show displacements."
    if exact:
        draw_exact(figure, run.history(), *exact)
        return f"The computed history, drawn over the exact one, and the difference of both: the exact value of `{exact[0]}` is `{exact[1]}`."
    return draw_look(figure, run, look or Look())


def shrink(path):
    """Reduces the colours of a picture, to make the file small. The colours are chosen to cover all that occur, even in narrow colour bars."""
    with Image.open(path) as image:
        small = image.convert("RGB").quantize(COLOURS_OF_A_FILE, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
    small.save(path, optimize=True)


def draw(outcome):
    """Draws the picture of a deck; returns its caption."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / f"{outcome.deck.stem}.png"
    plt.rcParams["font.size"] = 9
    study = outcome.directory / "study_l2_over_h.png"
    if study.exists():
        shutil.copy(study, path)
        caption = "Errors over the size of the cells, with slope triangles; drawn by the program."
    else:
        figure = plt.figure(figsize=(6.4, 4), layout="constrained")
        caption = draw_results(figure, outcome)
        figure.savefig(path, dpi=100)
        plt.close(figure)
    shrink(path)
    return caption
