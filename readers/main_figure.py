"""Draws the figure that answers the question of a study, from the tables that `overt analyze` wrote:

    import sys; sys.path.append("readers")
    from main_figure import main_figure
    main_figure("analysis", "figure.pdf")  # or .svg, .png

Which figure it is goes by what the study measured: what stays together, places that were pointed at, a scale, matches,
reliefs, times by set size, ratings, a psychometric function, correct answers, else shares of gaze on areas. Needs overt.py, pandas and matplotlib. Copy it and
change it.
"""
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import overt
import pandas


def of_all(rows):
    return rows[rows["observer"] == "all"]


def drawn_rows(axes, names, value, low, high, label, planted=None):
    """Values with intervals in rows, the names at the left."""
    at = np.arange(len(value))[::-1]
    axes.hlines(at, low, high, color="#555555")
    axes.plot(value, at, "o", color="#0072b2", markersize=4)
    if planted is not None:
        axes.plot(planted, at, "x", color="#d55e00", markersize=4)
    axes.set_yticks(at, list(names))
    axes.set_xlabel(label)


def drawn_curve(axes, x, y, low, high, x_label, y_label):
    """Values over numbers, with intervals and a line."""
    axes.vlines(x, low, high, color="#555555")
    axes.plot(x, y, "o-", color="#0072b2", markersize=4, linewidth=1)
    axes.set(xlabel=x_label, ylabel=y_label)


def of_scales(axes, rows, study):
    rows = of_all(rows)
    rows = rows[(rows["method"] == rows["method"].iloc[0]) & (rows["factor"] == rows["factor"].iloc[0])]
    x = pandas.to_numeric(rows["level"], errors="coerce")
    if x.isna().any():
        return drawn_rows(axes, rows["level"], rows["value"], rows["value_low"], rows["value_high"], f"place on the scale, {rows['method'].iloc[0]}")
    return drawn_curve(axes, x, rows["value"], rows["value_low"], rows["value_high"], rows["factor"].iloc[0], f"difference scale, {rows['method'].iloc[0]}")


def of_matches(axes, rows, study):
    rows = of_all(rows)
    rows = rows[rows["compared"].isna() & (rows["along"] == rows["along"].iloc[0])]
    along = rows["along"].iloc[0]
    drawn_curve(axes, rows["reference"], rows["match"], rows["match_low"], rows["match_high"], f"{along} of the reference", f"{along} that was set")
    axes.axline((rows["reference"].min(), rows["reference"].min()), slope=1, linestyle="--", color="#888888", linewidth=0.8)


def of_reliefs(axes, rows, study):
    rows = of_all(rows) if (rows["observer"] == "all").any() else rows
    drawn_rows(axes, rows["object"] + " " + rows["material"], rows["attitude_gain"], rows["attitude_gain_low"], rows["attitude_gain_high"],
               "gain of the attitudes that were set", rows["planted"])


def of_ratings(axes, rows, study):
    rows = of_all(rows)
    rows = rows[rows["factor"].isna()]
    drawn_rows(axes, rows["item"].fillna(rows["answer"]), rows["mean"], rows["mean_low"], rows["mean_high"], "mean rating", rows["planted"])


def of_chosen(axes, rows):
    """Where a slot is chosen and nothing is correct: how often each entry was, of the times that it was shown."""
    columns = [name for name in rows.columns if name.endswith(".material")]
    rows = rows[rows["value"].isin([name[:-len(".material")] for name in columns])]
    if rows.empty or rows["is_correct"].notna().any():
        return False
    shown = pandas.concat([rows[name] for name in columns]).dropna()
    chosen = pandas.Series([row[f"{row['value']}.material"] for _, row in rows.iterrows()])
    times = shown.value_counts().sort_index()
    share = chosen.value_counts().reindex(times.index, fill_value=0) / times
    half = 1.96 * (share * (1 - share) / times) ** 0.5  # of answers as if they were independent
    return drawn_rows(axes, times.index, share.to_numpy(), (share - half).clip(0).to_numpy(), (share + half).clip(upper=1).to_numpy(),
                      "chosen, of the times that it was shown")


def of_likenesses(axes, rows, study):
    """How often two stay together where the odd one out is chosen, as a matrix."""
    rows = of_all(rows)
    rows = rows[(rows["answer"] == rows["answer"].iloc[0]) & (rows["factor"] == rows["factor"].iloc[0])]
    levels = sorted(set(rows["a"]) | set(rows["b"]))
    shares = np.full((len(levels), len(levels)), np.nan)
    for _, row in rows.iterrows():
        i, j = levels.index(row["a"]), levels.index(row["b"])
        shares[i, j] = shares[j, i] = row["share"]
    image = axes.imshow(shares, cmap="cividis", vmin=0, vmax=1)
    axes.set_xticks(range(len(levels)), levels, rotation=90)
    axes.set_yticks(range(len(levels)), levels)
    axes.figure.colorbar(image, label="share that stays together")


def of_points(axes, rows, study):
    """Places that were pointed at, from the front: z is up."""
    rows = rows[rows["x"].notna() & (rows["on_object"] == rows["on_object"].iloc[0])]
    if rows.empty:
        return False
    for number, (answer, mine) in enumerate(rows.groupby("answer")):
        axes.plot(mine["x"], mine["z"], "os^"[number % 3], label=answer, markersize=4, fillstyle="none")
    axes.set(xlabel="x", ylabel="z", aspect="equal", adjustable="datalim")
    return axes.legend(frameon=False)


def of_trends(axes, rows, study):
    """Response times over a number; of a search with its target apart from that without. Other numbers have other figures."""
    rows = of_all(rows)
    rows = rows[rows["measure"].str.contains("time") & (rows["along"] == "set_size")]
    rows = rows[rows["within"] == "target"] if (rows["within"] == "target").any() else rows[rows["within"].isna()]
    if rows.empty:
        return False
    points = of_all(study.table("answer_trend_points"))
    for number, (_, row) in enumerate(rows.iterrows()):
        same = (points["measure"] == row["measure"]) & (points["along"] == row["along"]) & (points["within"].fillna("") == (row["within"] if pandas.notna(row["within"]) else ""))
        mine = points[same & (points["within_level"].fillna("") == (row["within_level"] if pandas.notna(row["within_level"]) else ""))]
        line = axes.plot(mine["x"], mine["mean"], "os^"[number % 3], label=row["within_level"], markersize=4)[0]
        axes.vlines(mine["x"], mine["mean_low"], mine["mean_high"], color=line.get_color())
        ends = np.array([mine["x"].min(), mine["x"].max()])
        axes.plot(ends, row["intercept"] + row["slope"] * ends, color=line.get_color(), linewidth=1)
    axes.set(xlabel=rows["along"].iloc[0], ylabel=rows["measure"].iloc[0])
    return axes.legend(frameon=False) if rows["within"].notna().any() else None


def of_answer_trials(axes, rows, study):
    return of_chosen(axes, rows)


def of_functions(axes, rows, study):
    rows = of_all(rows)
    function = rows[rows["within"].isna()].iloc[0]
    points = of_all(study.table("psychometric_points"))
    points = points[points["within"].isna() & (points["factor"] == function["factor"]) & (points["yes"] == function["yes"])]
    axes.vlines(points["x"], points["share_low"], points["share_high"], color="#555555")
    axes.plot(points["x"], points["share"], "o", color="#0072b2", markersize=4)
    axes.set(xlabel=function["factor"], ylabel=f"share of {function['yes']}")
    if pandas.notna(function["threshold"]):
        x = np.linspace(points["x"].min(), points["x"].max(), 200)
        lapse = 0 if pandas.isna(function["lapse"]) else function["lapse"]
        axes.plot(x, function["guess"] + (1 - function["guess"] - lapse) / (1 + np.exp(-function["slope"] * (x - function["threshold"]))), color="#0072b2", linewidth=1)


def of_correct(axes, rows, study):
    rows = rows[rows["correct"].notna()]
    if rows.empty:
        return False
    rows = rows[(rows["answer"] == rows["answer"].iloc[0]) & (rows["task"] == rows["task"].iloc[0])]
    return drawn_rows(axes, rows["observer"], rows["correct"], rows["correct_low"], rows["correct_high"], "share of correct answers")


def of_choices(axes, rows, study):
    rows = of_all(rows)
    drawn_rows(axes, rows["answer"] + " " + rows["choice"], rows["share"], rows["share_low"], rows["share_high"], "share of answers")


def of_areas(axes, rows, study):
    groups = [name for name in rows.columns[:rows.columns.get_loc("by_count")] if name != "area"]
    rows = rows[(rows[groups].isna() | (rows[groups] == "all")).all(axis=1)]
    drawn_rows(axes, rows["area"], rows["by_count"], rows["by_count_low"], rows["by_count_high"], "share of fixations on the area")


FIGURES = {"answer_likenesses": of_likenesses, "answered_points": of_points, "answer_scales": of_scales, "matches": of_matches, "reliefs": of_reliefs, "answer_trends": of_trends, "ratings": of_ratings,
           "answer_trials": of_answer_trials,
           "psychometric_functions": of_functions, "answers": of_correct, "answer_choices": of_choices, "areas": of_areas}


def main_figure(folder, file, width_mm=85, height_mm=65):
    """Draws into a file by its ending. Gives the name of the table that it is of."""
    study = overt.read_study(folder)
    with plt.rc_context({"font.size": 8, "svg.fonttype": "none", "axes.spines.top": False, "axes.spines.right": False}):
        for name, draw in FIGURES.items():
            if not (pathlib.Path(folder) / f"{name}.csv").exists():
                continue
            figure, axes = plt.subplots(figsize=(width_mm / 25.4, height_mm / 25.4), layout="constrained")
            drawn = draw(axes, study.table(name), study)
            if drawn is not False:
                figure.savefig(file, dpi=600)
            plt.close(figure)
            if drawn is not False:
                return name
    raise ValueError(f"{folder}: there is no answer and no area to draw")
