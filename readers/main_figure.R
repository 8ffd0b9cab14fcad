# Draws the figure that answers the question of a study, from the tables that `overt analyze` wrote:
#
#   source("readers/overt.R"); source("readers/main_figure.R")
#   main_figure("analysis", "figure.pdf")      # or .svg, .png
#
# Which figure it is goes by what the study measured: what stays together, places that were pointed at, a scale, matches,
# reliefs, times by set size, ratings, a psychometric function, correct answers, else shares of gaze on areas. Base R alone. Copy it and change it.

of_all <- function(rows) rows[rows$observer %in% "all", , drop = FALSE]

# Values with intervals in rows, the names at the left.
figure_of_rows <- function(names, value, low, high, label, planted = NULL) {
  at <- rev(seq_along(value))
  par(mar = c(3, max(3, 0.5 * max(nchar(names))), 0.5, 0.5))
  plot(value, at, xlim = range(value, low, high, planted, 0, na.rm = TRUE), ylim = c(0.5, length(at) + 0.5), yaxt = "n", ylab = "", xlab = label, pch = 19, bty = "l")
  segments(low, at, high, at)
  if (!is.null(planted)) points(planted, at, pch = 4, col = "#d55e00")
  axis(2, at = at, labels = names, las = 1, tick = FALSE)
}

# Values over numbers, with intervals and a line.
figure_of_curve <- function(x, y, low, high, x_label, y_label, identity = FALSE) {
  par(mar = c(3, 3.2, 0.5, 0.5))
  plot(x, y, ylim = range(y, low, high, na.rm = TRUE), xlab = x_label, ylab = y_label, pch = 19, bty = "l", type = "b")
  segments(x, low, x, high)
  if (identity) abline(0, 1, lty = 2)
}

# Where a slot is chosen and nothing is correct: how often each entry was, of the times that it was shown.
figure_of_chosen <- function(rows) {
  columns <- grep("[.]material$", names(rows), value = TRUE)
  slots <- sub("[.]material$", "", columns)
  rows <- rows[rows$value %in% slots, ]
  if (nrow(rows) == 0 || any(!is.na(rows$is_correct))) return(FALSE)
  shown <- unlist(rows[columns])
  chosen <- mapply(function(i, slot) rows[i, paste0(slot, ".material")], seq_len(nrow(rows)), rows$value)
  names <- sort(unique(shown[!is.na(shown)]))
  times <- vapply(names, function(name) sum(shown == name, na.rm = TRUE), 0)
  share <- vapply(names, function(name) sum(chosen == name), 0) / times
  half <- 1.96 * sqrt(share * (1 - share) / times) # of answers as if they were independent
  figure_of_rows(names, share, pmax(0, share - half), pmin(1, share + half), "chosen, of the times that it was shown")
}

figures <- list(
  # How often two stay together where the odd one out is chosen.
  answer_likenesses = function(rows, study) {
    rows <- of_all(rows)
    rows <- rows[rows$answer == rows$answer[1] & rows$factor == rows$factor[1], ]
    levels <- sort(unique(c(rows$a, rows$b)))
    shares <- matrix(NA, length(levels), length(levels))
    shares[cbind(match(rows$a, levels), match(rows$b, levels))] <- rows$share
    shares[cbind(match(rows$b, levels), match(rows$a, levels))] <- rows$share
    room <- max(3, 0.5 * max(nchar(levels)))
    par(mar = c(room, room, 1.5, 0.5))
    image(seq_along(levels), seq_along(levels), shares[, rev(seq_along(levels)), drop = FALSE], zlim = c(0, 1), col = hcl.colors(64, "cividis"), axes = FALSE, xlab = "", ylab = "")
    axis(1, seq_along(levels), levels, las = 2, tick = FALSE)
    axis(2, seq_along(levels), rev(levels), las = 1, tick = FALSE)
    known <- which(!is.na(shares), arr.ind = TRUE)
    text(known[, 1], length(levels) + 1 - known[, 2], round(100 * shares[known]), col = ifelse(shares[known] > 0.5, "black", "white"), cex = 0.8)
    mtext("stay together, % of the trials that show both", cex = 1)
  },
  # Places that were pointed at, from the front: z is up.
  answered_points = function(rows, study) {
    rows <- rows[!is.na(rows$x) & rows$on_object == rows$on_object[1], ]
    if (nrow(rows) == 0) return(FALSE)
    answers <- sort(unique(rows$answer))
    par(mar = c(3, 3.2, 0.5, 0.5))
    plot(rows$x, rows$z, asp = 1, xlab = "x", ylab = "z", bty = "l", pch = match(rows$answer, answers))
    legend("topleft", legend = answers, pch = seq_along(answers), bty = "n")
  },
  answer_scales = function(rows, study) {
    rows <- of_all(rows)
    rows <- rows[rows$method == rows$method[1] & rows$factor == rows$factor[1], ]
    x <- suppressWarnings(as.numeric(rows$level))
    if (anyNA(x)) return(figure_of_rows(rows$level, rows$value, rows$value_low, rows$value_high, paste("place on the scale,", rows$method[1])))
    figure_of_curve(x, rows$value, rows$value_low, rows$value_high, rows$factor[1], paste("difference scale,", rows$method[1]))
  },
  matches = function(rows, study) {
    rows <- of_all(rows)
    rows <- rows[is.na(rows$compared) & rows$along == rows$along[1], ]
    figure_of_curve(rows$reference, rows$match, rows$match_low, rows$match_high, paste(rows$along[1], "of the reference"), paste(rows$along[1], "that was set"), TRUE)
  },
  reliefs = function(rows, study) {
    rows <- if (any(rows$observer == "all")) of_all(rows) else rows
    figure_of_rows(paste(rows$object, rows$material), rows$attitude_gain, rows$attitude_gain_low, rows$attitude_gain_high, "gain of the attitudes that were set", rows$planted)
  },
  # Response times over the set size; of a search with its target apart from that without. Other numbers have other figures.
  answer_trends = function(rows, study) {
    rows <- of_all(rows)
    rows <- rows[grepl("time", rows$measure) & rows$along == "set_size", ]
    rows <- if (any(rows$within %in% "target")) rows[rows$within %in% "target", ] else rows[is.na(rows$within), ]
    if (nrow(rows) == 0) return(FALSE)
    points <- of_all(study$table("answer_trend_points"))
    points <- points[points$measure == rows$measure[1] & points$along == rows$along[1] & points$within %in% rows$within & points$within_level %in% rows$within_level, ]
    par(mar = c(3, 3.2, 0.5, 0.5))
    plot(points$x, points$mean, ylim = range(points$mean, points$mean_low, points$mean_high, na.rm = TRUE), xlab = rows$along[1], ylab = rows$measure[1], bty = "l", pch = 18 + match(points$within_level, rows$within_level))
    segments(points$x, points$mean_low, points$x, points$mean_high)
    for (i in seq_len(nrow(rows))) lines(range(points$x), rows$intercept[i] + rows$slope[i] * range(points$x), lty = i)
    if (!anyNA(rows$within)) legend("topleft", legend = rows$within_level, pch = 18 + seq_len(nrow(rows)), lty = seq_len(nrow(rows)), bty = "n")
  },
  ratings = function(rows, study) {
    rows <- of_all(rows)
    rows <- rows[is.na(rows$factor), ]
    figure_of_rows(ifelse(is.na(rows$item), rows$answer, rows$item), rows$mean, rows$mean_low, rows$mean_high, "mean rating", rows$planted)
  },
  answer_trials = function(rows, study) figure_of_chosen(rows),
  psychometric_functions = function(rows, study) {
    rows <- of_all(rows)
    f <- rows[is.na(rows$within), ][1, ]
    points <- of_all(study$table("psychometric_points"))
    points <- points[is.na(points$within) & points$factor == f$factor & points$yes == f$yes, ]
    figure_of_curve(points$x, points$share, points$share_low, points$share_high, f$factor, paste("share of", f$yes))
    x <- seq(min(points$x), max(points$x), length.out = 200)
    lapse <- if (is.na(f$lapse)) 0 else f$lapse
    if (!is.na(f$threshold)) lines(x, f$guess + (1 - f$guess - lapse) / (1 + exp(-f$slope * (x - f$threshold))), col = "#0072b2")
  },
  answers = function(rows, study) {
    rows <- rows[!is.na(rows$correct), ]
    if (nrow(rows) == 0) return(FALSE)
    rows <- rows[rows$answer == rows$answer[1] & rows$task == rows$task[1], ]
    figure_of_rows(rows$observer, rows$correct, rows$correct_low, rows$correct_high, "share of correct answers")
  },
  answer_choices = function(rows, study) {
    rows <- of_all(rows)
    figure_of_rows(paste(rows$answer, rows$choice), rows$share, rows$share_low, rows$share_high, "share of answers")
  },
  areas = function(rows, study) {
    groups <- setdiff(names(rows)[seq_len(match("by_count", names(rows)) - 1)], "area")
    rows <- rows[rowSums(is.na(rows[groups]) | rows[groups] == "all") == length(groups), ]
    figure_of_rows(rows$area, rows$by_count, rows$by_count_low, rows$by_count_high, "share of fixations on the area")
  })

# Draws into a file by its ending, or, without one, on the screen. Says which table it is of.
main_figure <- function(folder, file = NULL, width_mm = 85, height_mm = 65) {
  study <- read_study(folder)
  if (!is.null(file)) {
    open <- switch(tools::file_ext(file), pdf = grDevices::pdf, svg = grDevices::svg, png = function(...) grDevices::png(..., units = "in", res = 600), NULL)
    if (is.null(open)) stop(sprintf("%s: give a file that ends in .pdf, .svg or .png", file), call. = FALSE)
    open(file, width = width_mm / 25.4, height = height_mm / 25.4)
    on.exit(grDevices::dev.off())
  }
  par(ps = 8, cex = 1, mgp = c(1.8, 0.5, 0), tcl = -0.3)
  for (name in names(figures)) {
    if (!file.exists(file.path(folder, paste0(name, ".csv")))) next
    if (!identical(figures[[name]](study$table(name), study), FALSE)) return(name)
  }
  stop(sprintf("%s: there is no answer and no area to draw", folder), call. = FALSE)
}
