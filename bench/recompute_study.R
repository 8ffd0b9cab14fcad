# Recomputes tables of one analysis from its fixations and trials alone, with R's own functions, and says how far
# the program's numbers are off:
#
#   Rscript bench/recompute_study.R ANALYSIS
#
# ANALYSIS is a folder that `overt analyze` wrote. It needs the package jsonlite. Recomputed are the shares of
# areas, differences between levels with their p, Holm's corrections, effect sizes, Bayes factors and tests of
# equivalence, WSS, intervals that are not drawn of shares and WSS, measures of trials between levels (dwell, first arrival and others that trials tell), where the
# first fixations go, shares by second, transitions between areas, the sums, means and peaks of maps (of an analysis with
# --meshes), and the effects of factors. Intervals that are drawn (bootstraps), distances along the surface and what maps
# of single observers have in common are not.
# Ends with status 1 if a number is farther off than its table's rounding, or a p than chance allows.

folder <- commandArgs(trailingOnly = TRUE)[1]
read_table <- function(name) read.csv(file.path(folder, paste0(name, ".csv")), na.strings = "n/a", check.names = FALSE,
                                      colClasses = c(observer = "character"))
study <- jsonlite::fromJSON(file.path(folder, "study.json"), simplifyVector = FALSE)
parameter <- function(name) Filter(function(one) one$name == name, study$parameters)[[1]]$value
by <- unlist(study$by)
compare <- parameter("compare")
smallest_effect <- as.numeric(parameter("smallest-effect"))
trials <- suppressWarnings(read_table("trials"))
fixations <- suppressWarnings(read_table("fixations"))
fixations <- fixations[fixations$counted == 1, ]
trials <- trials[trials$excluded == 0, ]
mm_per_deg <- sapply(study$objects, function(one) one$mm_per_deg)
names(mm_per_deg) <- sapply(study$objects, function(one) one$id)

worst <- data.frame()
hold <- function(what, ours, theirs, tolerance) {
  both_missing <- is.na(ours) & is.na(theirs)
  off <- ifelse(both_missing, 0, ifelse(is.na(ours) | is.na(theirs), Inf, abs(ours - theirs)))
  if (length(off) == 0) return(invisible())
  worst <<- rbind(worst, data.frame(what = what, numbers = length(off), worst = max(off), allowed = tolerance,
                                    holds = max(off) <= tolerance))
}
rounding <- 1.1e-6
holm <- function(p) p.adjust(p, "holm")

# Exact flips of the signs of observers' differences.
flip_p <- function(differences) {
  n <- length(differences)
  if (n < 2) return(NA)
  if (n > 16) return(NA)
  signs <- as.matrix(expand.grid(rep(list(c(1, -1)), n)))
  mean(abs(signs %*% differences) >= abs(sum(differences)) - 1e-12 * sum(abs(differences)))
}
bayes_factor <- function(t, n, r = sqrt(2) / 2) {
  v <- n - 1
  with <- integrate(function(x) {
    g <- exp(x)
    w <- 1 + n * g * r^2
    exp(-0.5 * log(w) - (v + 1) / 2 * (log1p(t^2 / (w * v)) - log1p(t^2 / v)) - 0.5 * log(2 * pi) - 1.5 * x - 0.5 / g + x)
  }, -10, 60, rel.tol = 1e-10, subdivisions = 2000)$value
  with
}
evidence_of <- function(d) {
  n <- length(d)
  nothing <- c(NA, NA, NA, NA, NA)
  if (n < 2 || !(sd(d) > 1e-12 * max(abs(d)))) return(nothing)
  t <- mean(d) / sd(d) * sqrt(n)
  bound <- smallest_effect * sqrt(n)
  equivalence <- suppressWarnings(max(1 - pt(t, n - 1, -bound), pt(t, n - 1, bound)))
  if (n < 3) return(c(mean(d) / sd(d), NA, NA, bayes_factor(t, n), equivalence))
  end <- function(p) suppressWarnings(uniroot(function(x) pt(t, n - 1, x) - p, t + c(-40, 40), tol = 1e-10)$root) / sqrt(n)
  c(exp(lgamma((n - 1) / 2) - lgamma((n - 2) / 2)) / sqrt((n - 1) / 2) * mean(d) / sd(d), end(0.975), end(0.025),
    bayes_factor(t, n), equivalence)
}
wss <- function(f) if (nrow(f) < 2) NA else sum(apply(f[, c("x_mm", "y_mm", "z_mm")], 2, var))
on_area <- function(f, area) vapply(strsplit(ifelse(is.na(f$part), "", f$part), " "), function(parts) area %in% parts, logical(1))

# Student's interval of the mean of fewer than 25 observers on the scale of logits (shares) or logarithms, by the delta
# method: "Intervals and chance" of docs/methods.md.
confidence <- as.numeric(parameter("confidence"))
interval_of <- function(value, se, n, is_share) {
  if (n < 3 || n >= 25) return(c(NA, NA))
  half <- qt(0.5 + confidence / 2, n - 1) * se
  if (is_share) {
    if (value <= 0 || value >= 1) return(c(NA, NA))
    plogis(qlogis(value) + c(-1, 1) * half / (value * (1 - value)))
  } else if (value > 0) value * exp(c(-1, 1) * half / value) else c(NA, NA)
}
mean_interval <- function(values, is_share) {
  values <- values[!is.na(values)]
  interval_of(mean(values), sd(values) / sqrt(length(values)), length(values), is_share)
}
hold_interval <- function(what, ours, low, high, tolerance) {
  told <- !is.na(ours[, 1])
  hold(paste0(what, "_low"), ours[told, 1], low[told], tolerance)
  hold(paste0(what, "_high"), ours[told, 2], high[told], tolerance)
}

# Rows of a table stand for the trials with their keys; "all" takes any.
of_keys <- function(data, row, columns) {
  for (column in columns) if (row[[column]] != "all") data <- data[data[[column]] == row[[column]], ]
  data
}
means_of_observers <- function(f, value) vapply(split(f, f$observer), value, numeric(1))

if (file.exists(file.path(folder, "areas.csv"))) {
  areas <- suppressWarnings(read_table("areas"))
  columns <- intersect(by, names(areas))
  ours <- t(vapply(seq_len(nrow(areas)), function(i) {
    f <- of_keys(fixations, areas[i, ], columns)
    if (nrow(f) == 0) return(rep(NA_real_, 7))
    inside <- on_area(f, areas$area[i])
    observers <- split(seq_len(nrow(f)), f$observer)
    by_count <- vapply(observers, function(o) mean(inside[o]), 1)
    by_duration <- vapply(observers, function(o) sum(f$duration_s[o][inside[o]]) / sum(f$duration_s[o]), 1)
    c(mean(by_count), mean(by_duration), mean(inside), mean_interval(by_count, TRUE), mean_interval(by_duration, TRUE))
  }, numeric(7)))
  # Objects that lack an area have no share of it: where studies have such, rows differ and say so.
  hold("areas: by_count", ours[, 1], areas$by_count, rounding)
  hold("areas: by_duration", ours[, 2], areas$by_duration, rounding)
  hold("areas: pooled", ours[, 3], areas$pooled, rounding)
  hold_interval("areas: by_count", ours[, 4:5, drop = FALSE], areas$by_count_low, areas$by_count_high, rounding)
  hold_interval("areas: by_duration", ours[, 6:7, drop = FALSE], areas$by_duration_low, areas$by_duration_high, rounding)
}

# Differences within observers: of each object and group, then means over these.
differences_of <- function(row, others, value) {
  f <- of_keys(fixations, row, others)
  cells <- split(f, f[, unique(c("observer", "object", others)), drop = FALSE], drop = TRUE)
  found <- lapply(cells, function(cell) {
    a <- cell[cell[[compare]] == row$a, ]
    b <- cell[cell[[compare]] == row$b, ]
    if (nrow(a) == 0 || nrow(b) == 0) return(NULL)
    data.frame(observer = cell$observer[1], value = value(a) - value(b))
  })
  found <- do.call(rbind, found)
  if (is.null(found)) return(numeric(0))
  found <- found[!is.na(found$value), ]
  vapply(split(found$value, found$observer), mean, numeric(1))
}
compare_rows <- function(table, name, prefix, value_of, difference, p, others) {
  values <- lapply(seq_len(nrow(table)), function(i) differences_of(table[i, ], others, value_of(table[i, ])))
  scale <- max(1, max(abs(table[[difference]]), na.rm = TRUE))
  hold(paste0(name, ": ", difference), vapply(values, function(d) if (length(d)) mean(d) else NA_real_, 1),
       table[[difference]], scale * 1e-6 + rounding)
  exact <- lengths(values) <= 16
  hold(paste0(name, ": ", p), vapply(values[exact], flip_p, 1), table[[p]][exact], rounding)
  evidence <- t(vapply(values, evidence_of, numeric(5)))
  for (i in 1:5) {
    column <- paste0(prefix, c("effect_size", "effect_size_low", "effect_size_high", "bayes_factor", "equivalence_p")[i])
    theirs <- table[[column]]
    hold(paste0(name, ": ", column), evidence[, i] / pmax(1, abs(theirs)), theirs / pmax(1, abs(theirs)), 2e-5)
  }
}
others_of <- function(table) setdiff(intersect(by, names(table)), compare)
if (file.exists(file.path(folder, "area_pairs.csv"))) {
  pairs <- suppressWarnings(read_table("area_pairs"))
  others <- others_of(pairs)
  compare_rows(pairs, "area_pairs", "", function(row) function(f) mean(on_area(f, row$area)), "difference", "p", others)
  is_all <- if (length(others)) Reduce(`&`, lapply(others, function(one) pairs[[one]] == "all")) else rep(TRUE, nrow(pairs))
  corrected <- ave(pairs$p, pairs$area, is_all, FUN = holm)
  hold("area_pairs: p_holm", corrected, pairs$p_holm, 20 * rounding)
  hold("area_pairs: p_holm_areas", ave(pairs$p, is_all, FUN = holm), pairs$p_holm_areas, 60 * rounding)
}
if (file.exists(file.path(folder, "table1_pairs.csv"))) {
  pairs <- suppressWarnings(read_table("table1_pairs"))
  others <- others_of(pairs)
  if (length(unique(fixations$object)) == 1 && length(mm_per_deg) > 0 && !is.null(mm_per_deg[[1]])) {
    per_deg <- mm_per_deg[[unique(fixations$object)]]
    compare_rows(pairs, "table1_pairs", "wss_", function(row) function(f) wss(f) / per_deg^2, "wss_difference_deg2", "wss_p", others)
  }
  values <- vapply(seq_len(nrow(pairs)), function(i) {
    d <- differences_of(pairs[i, ], others, wss)
    if (length(d)) mean(d) else NA_real_
  }, 1)
  hold("table1_pairs: wss_difference_mm2", values / pmax(1, abs(pairs$wss_difference_mm2)),
       pairs$wss_difference_mm2 / pmax(1, abs(pairs$wss_difference_mm2)), 1e-5)
}
if (file.exists(file.path(folder, "figure5_distribution.csv"))) {
  spread <- suppressWarnings(read_table("figure5_distribution"))
  divided_by_n <- function(f) if (nrow(f) < 2) NA_real_ else wss(f) * (nrow(f) - 1) / nrow(f)
  ours <- t(vapply(seq_len(nrow(spread)), function(i) {
    f <- of_keys(fixations, spread[i, ], intersect(by, names(spread)))
    f <- f[f$object == spread$on_object[i], ]
    without <- vapply(unique(f$observer), function(one) divided_by_n(f[f$observer != one, ]), 1)
    n <- length(without)
    # The standard error of the jackknife.
    se <- sqrt((n - 1) / n * sum((without - mean(without))^2))
    c(divided_by_n(f), if (anyNA(without)) c(NA, NA) else interval_of(divided_by_n(f), se, n, FALSE))
  }, numeric(3)))
  hold("figure5_distribution: wss_mm2", ours[, 1] / spread$wss_mm2, spread$wss_mm2 / spread$wss_mm2, 1e-6)
  hold_interval("figure5_distribution: wss_mm2", ours[, 2:3, drop = FALSE] / spread$wss_mm2,
                spread$wss_mm2_low / spread$wss_mm2, spread$wss_mm2_high / spread$wss_mm2, 1e-5)
}

# What trials come to, between levels: means over an observer's trials on one object with all else alike.
same_trial <- function(data) do.call(paste, c(data[c("observer", "session_folder", "trial")], sep = "\r"))
trial_values <- function(measure, of) {
  here <- same_trial(trials)
  area <- if (is.na(of)) "" else of
  if (measure == "dwell_s") return(trials[[paste0(area, "_s")]])
  if (measure == "reached") return((trials[[paste0("on_", area)]] > 0) * 1)
  if (measure == "fixations") return(trials$fixations)
  if (measure == "fixation_s") return(ifelse(trials$fixations > 0, trials$fixated_s / trials$fixations, NA))
  if (measure == "first_arrival_s") {
    f <- fixations[on_area(fixations, area), ]
    first <- tapply(f$onset_s, same_trial(f), min)
    arrival <- as.vector(first[here])
    return(ifelse(is.na(trials[[paste0("on_", area)]]), NA, ifelse(is.na(arrival), trials$presentation_s, arrival)))
  }
  NULL
}
measure_difference <- function(row) {
  values <- trial_values(row$measure, row$of)
  cell <- do.call(paste, c(trials["observer"], trials["object"], trials[setdiff(by, c(compare, "object"))], sep = "\r"))
  mean_at <- function(level) {
    here <- trials[[compare]] == level & !is.na(values)
    tapply(values[here], cell[here], mean)
  }
  a <- mean_at(row$a)
  b <- mean_at(row$b)
  both <- intersect(names(a), names(b))
  vapply(split(as.vector(a[both] - b[both]), sub("\r.*", "", both)), mean, numeric(1))
}
if (file.exists(file.path(folder, "measure_differences.csv"))) {
  differences <- read.csv(file.path(folder, "measure_differences.csv"), na.strings = "n/a", check.names = FALSE)
  known <- differences[differences$measure %in% c("dwell_s", "reached", "fixations", "fixation_s", "first_arrival_s"), ]
  values <- lapply(seq_len(nrow(known)), function(i) measure_difference(known[i, ]))
  hold("measure_differences: difference", vapply(values, mean, 1), known$difference, 1e-5)
  exact <- lengths(values) <= 16
  hold("measure_differences: p", vapply(values[exact], flip_p, 1), known$p[exact], rounding)
  hold("measure_differences: p_holm", ave(differences$p, differences$measure, FUN = holm), differences$p_holm, 100 * rounding)
}
if (file.exists(file.path(folder, "first_fixations.csv"))) {
  first <- suppressWarnings(read.csv(file.path(folder, "first_fixations.csv"), na.strings = "n/a", check.names = FALSE))
  f <- fixations[order(same_trial(fixations), fixations$onset_s), ]
  f$number <- ave(rep(1, nrow(f)), same_trial(f), FUN = cumsum)
  ours <- vapply(seq_len(nrow(first)), function(i) {
    own <- of_keys(f, first[i, ], intersect(by, names(first)))
    own <- own[own$number == first$number[i], ]
    mean(tapply(on_area(own, first$area[i]) * 1, own$observer, mean))
  }, 1)
  hold("first_fixations: at", ours, first$at, rounding)
}

# The share by duration of each stretch of time: what of each fixation lies within it.
in_time <- function(f) f[order(same_trial(f), f$onset_s), ]
if (file.exists(file.path(folder, "time_course.csv"))) {
  course <- suppressWarnings(read_table("time_course"))
  key <- setdiff(names(course)[seq_len(which(names(course) == "from_s") - 1)], "area")
  ours <- t(vapply(seq_len(nrow(course)), function(i) {
    row <- course[i, ]
    f <- of_keys(fixations, row, key)
    within <- pmax(0, pmin(f$onset_s + f$duration_s, row$to_s) - pmax(f$onset_s, row$from_s))
    inside <- on_area(f, row$area) * within
    shares <- tapply(inside, f$observer, sum) / tapply(within, f$observer, sum)
    shares <- shares[is.finite(shares)]
    c(mean(shares), length(shares), mean_interval(shares, TRUE))
  }, numeric(4)))
  hold("time_course: share", ours[, 1], course$share, rounding)
  hold("time_course: observers", ours[, 2], course$observers, 0)
  hold_interval("time_course: share", ours[, 3:4, drop = FALSE], course$share_low, course$share_high, 5e-6)
}

# From each counted fixation to the next of its trial, unless one between them was not on the surface.
if (file.exists(file.path(folder, "area_transitions.csv"))) {
  transitions <- suppressWarnings(read_table("area_transitions"))
  every <- suppressWarnings(read_table("fixations"))
  every <- in_time(every[same_trial(every) %in% same_trial(trials), ])
  every <- every[every$counted == 1 | every$why == "not on the surface", ]
  follows <- c(FALSE, same_trial(every)[-1] == same_trial(every)[-nrow(every)])
  kept <- every$counted == 1
  pairs_to <- which(follows & kept & c(FALSE, kept[-length(kept)]))
  after <- every[pairs_to, ]
  before <- every[pairs_to - 1, ]
  columns <- intersect(by, names(transitions))
  ours <- t(vapply(seq_len(nrow(transitions)), function(i) {
    row <- transitions[i, ]
    here <- rep(TRUE, nrow(after))
    for (column in columns) if (row[[column]] != "all") here <- here & after[[column]] == row[[column]]
    from <- on_area(before[here, ], row$from)
    to <- on_area(after[here, ], row$to)
    observer <- after$observer[here]
    departures <- tapply(from, observer, sum)
    arrivals <- tapply(from & to, observer, sum)
    chance <- tapply(to, observer, mean)
    known <- departures > 0
    probability <- arrivals[known] / departures[known]
    c(mean(probability), mean(chance[known]), mean(probability - chance[known]), sum(arrivals), sum(departures),
      mean_interval(probability, TRUE))
  }, numeric(7)))
  for (i in 1:3) hold(paste0("area_transitions: ", c("probability", "chance", "over_chance")[i]), ours[, i],
                      transitions[[c("probability", "chance", "over_chance")[i]]], rounding)
  hold("area_transitions: transitions", ours[, 4], transitions$transitions, 0)
  hold("area_transitions: departures", ours[, 5], transitions$departures, 0)
  hold_interval("area_transitions: probability", ours[, 6:7, drop = FALSE], transitions$probability_low,
                transitions$probability_high, 5e-6)
}

# What the trials of each observer come to in an area: a visit is a run of fixations on it that none elsewhere or beside
# the object interrupts, and a trial without an arrival counts with its whole presentation.
if (file.exists(file.path(folder, "areas.csv"))) {
  every <- suppressWarnings(read_table("fixations"))
  every <- in_time(every[same_trial(every) %in% same_trial(trials), ])
  every <- every[every$counted == 1 | every$why == "not on the surface", ]
  here <- same_trial(trials)
  measures <- c("dwell_s", "visits", "visit_s", "reached", "first_arrival_s", "first_arrival_number")
  of_trial <- lapply(unique(areas$area), function(area) {
    inside <- on_area(every, area) & every$counted == 1
    begins <- inside & !(c(FALSE, inside[-length(inside)]) & c(FALSE, same_trial(every)[-1] == same_trial(every)[-nrow(every)]))
    by_trial <- function(v) {
      sums <- as.vector(tapply(v, same_trial(every), sum)[here])
      ifelse(is.na(sums), 0, sums)
    }
    number <- ave(every$counted, same_trial(every), FUN = cumsum)
    first <- function(v) as.vector(tapply(v[inside], same_trial(every)[inside], min)[here])
    arrival <- first(every$onset_s)
    found <- cbind(by_trial(every$duration_s * inside), by_trial(begins * 1), NA, (!is.na(arrival)) * 1,
                   ifelse(is.na(arrival), trials$presentation_s, arrival), first(number))
    found[is.na(trials[[paste0("on_", area)]]), ] <- NA
    found
  })
  names(of_trial) <- unique(areas$area)
  ours <- t(vapply(seq_len(nrow(areas)), function(i) {
    row <- areas[i, ]
    taken <- rep(TRUE, nrow(trials))
    for (column in intersect(by, names(areas))) if (row[[column]] != "all") taken <- taken & trials[[column]] == row[[column]]
    values <- of_trial[[row$area]][taken, , drop = FALSE]
    observer <- trials$observer[taken]
    of_observers <- function(v) {
      known <- !is.na(v)
      mean(tapply(v[known], observer[known], mean))
    }
    known <- !is.na(values[, 1])
    time <- tapply(values[known, 1], observer[known], sum)
    number <- tapply(values[known, 2], observer[known], sum)
    c(of_observers(values[, 1]), of_observers(values[, 2]), mean((time / number)[number > 0]),
      of_observers(values[, 4]), of_observers(values[, 5]), of_observers(values[, 6]))
  }, numeric(6)))
  for (i in seq_along(measures)) hold(paste0("areas: ", measures[i]), ours[, i], areas[[measures[i]]], 2e-6)
}

# Maps: what they hold in all is what the fixations of a trial hold; mean and peak are those of the vertices of the mesh
# that was written, each with a third of the area around it.
read_map <- function(file) {
  from <- file(file, "rb")
  on.exit(close(from))
  head <- character()
  while (length(head) == 0 || tail(head, 1) != "end_header") head <- c(head, readLines(from, 1))
  counted <- function(what) as.integer(sub(".* ", "", grep(paste("^element", what), head, value = TRUE)))
  vertices <- matrix(readBin(from, "raw", counted("vertex") * 19), 19)
  faces <- matrix(readBin(from, "raw", counted("face") * 13), 13)
  number <- function(bytes) readBin(as.vector(vertices[bytes, ]), "numeric", ncol(vertices), size = 4, endian = "little")
  corner <- function(k) 1 + readBin(as.vector(faces[2:5 + 4 * k, ]), "integer", ncol(faces), size = 4, endian = "little")
  place <- cbind(number(1:4), number(5:8), number(9:12))
  corners <- sapply(0:2, corner)
  a <- place[corners[, 2], ] - place[corners[, 1], ]
  b <- place[corners[, 3], ] - place[corners[, 1], ]
  area <- sqrt((a[, 2] * b[, 3] - a[, 3] * b[, 2])^2 + (a[, 3] * b[, 1] - a[, 1] * b[, 3])^2 + (a[, 1] * b[, 2] - a[, 2] * b[, 1])^2) / 2
  whole <- sum(sapply(1:3, function(k) sum(area / 3 * number(16:19)[corners[, k]])))
  c(sum(area), whole, whole / sum(area), max(number(16:19)))
}
if (file.exists(file.path(folder, "maps.csv"))) {
  maps <- read.csv(file.path(folder, "maps.csv"), na.strings = "n/a", check.names = FALSE)
  maps <- maps[!is.na(maps$total), ]
  columns <- intersect(by, names(maps))
  ours <- t(vapply(seq_len(nrow(maps)), function(i) {
    f <- of_keys(fixations, maps[i, ], columns)
    f <- f[f$object == maps$on_object[i], ]
    own <- of_keys(trials, maps[i, ], columns)
    n <- sum(own$object == maps$on_object[i])
    c(if (maps$weighting[i] == "duration") 1000 * sum(f$duration_s) / n else nrow(f) / n, nrow(f), length(unique(f$observer)))
  }, numeric(3)))
  hold("maps: total", ours[, 1] / maps$total, maps$total / maps$total, 1e-6)
  hold("maps: fixations", ours[, 2], maps$fixations, 0)
  meshes <- file.path(folder, "meshes", paste0("map_", maps$on_object, "_", vapply(seq_len(nrow(maps)), function(i) {
    told <- setdiff(columns, "object")
    told <- told[vapply(told, function(column) maps[[column]][i] != "all", TRUE)]
    if (length(told)) paste(told, vapply(told, function(column) as.character(maps[[column]][i]), ""), sep = "_", collapse = "__") else "all"
  }, ""), ".ply"))
  with <- which(maps$weighting == "duration" & file.exists(meshes))
  if (length(with)) {
    ours <- t(vapply(meshes[with], read_map, numeric(4)))
    for (i in 1:4) {
      theirs <- maps[[c("area_mm2", "total", "mean", "peak")[i]]][with]
      # Values and places are written in four bytes.
      hold(paste0("meshes of maps: ", c("area_mm2", "total", "mean", "peak")[i]), ours[, i] / theirs, theirs / theirs, 1e-6)
    }
  }
}

# How many fixations a way has, and how long they are: of each trial, then of each observer.
if (file.exists(file.path(folder, "scanpaths.csv"))) {
  ways <- suppressWarnings(read_table("scanpaths"))
  columns <- intersect(by, names(ways))
  ours <- t(vapply(seq_len(nrow(ways)), function(i) {
    own <- of_keys(trials, ways[i, ], columns)
    f <- of_keys(fixations, ways[i, ], columns)
    number <- vapply(split(own$fixations, own$observer), mean, 1)
    of_trials <- tapply(f$duration_s, same_trial(f), mean)
    lasting <- tapply(of_trials, sub("\r.*", "", names(of_trials)), mean)
    c(mean(number), mean(lasting))
  }, numeric(2)))
  hold("scanpaths: fixations", ours[, 1], ways$fixations, 1e-5)
  hold("scanpaths: fixation_s", ours[, 2], ways$fixation_s, 2e-6)
}

# Effects of factors: contrasts beside what trials have in common, flips of observers' signs.
flip_contrasts <- function(y, observer, contrasts, beside) {
  centre <- function(m) apply(as.matrix(m), 2, function(v) v - ave(v, observer))
  y <- centre(y)
  contrasts <- centre(contrasts)
  base <- qr(centre(beside))
  q <- qr.Q(base)[, seq_len(base$rank), drop = FALSE]
  off <- function(m) m - q %*% crossprod(q, m)
  rest <- off(y)
  weights <- off(contrasts)
  keep <- colSums(weights^2) > 1e-9
  weights <- weights[, keep, drop = FALSE]
  if (ncol(weights) == 0) return(c(NA, NA))
  gifts <- rowsum(weights * as.vector(rest), observer)
  along <- lapply(seq_len(ncol(weights)), function(k) rowsum(q * weights[, k], observer))
  given <- rowSums(rowsum(weights^2, observer)) > 1e-9
  n <- sum(given)
  if (n < 2 || n > 14) return(c(NA, NA))
  signs <- as.matrix(expand.grid(rep(list(c(1, -1)), n)))
  all_signs <- matrix(1, nrow(signs), nrow(gifts))
  all_signs[, given] <- signs
  size <- rep(0, nrow(signs))
  for (k in seq_len(ncol(weights))) {
    squares <- sum(gifts[, k]^2)
    if (!(squares > 0)) next
    left <- 1 - rowSums((all_signs %*% along[[k]])^2) / sum(weights[, k]^2)
    size <- pmax(size, ifelse(left > 1e-9, (all_signs %*% gifts[, k])^2 / squares / left, 0))
  }
  c(sqrt(size[1]), mean(size >= size[1] * (1 - 1e-9)))
}
indicator <- function(x) outer(x, unique(x), `==`) * 1
pairs_of <- function(levels) if (length(levels) < 2) NULL else combn(levels, 2, simplify = FALSE)
effect_of <- function(measure, effect) {
  data <- trials
  if (measure == "log WSS") {
    data$value <- ifelse(!is.na(data$wss_mm2) & data$wss_mm2 > 0, log(data$wss_mm2), NA)
  } else {
    data$value <- data[[paste0("on_", sub("share on ", "", measure))]] / data$fixations
  }
  data <- data[is.finite(data$value), ]
  columns <- setdiff(by, c("object", "observer"))
  key <- function(of) do.call(paste, c(list(data$object), data[of], sep = "\r"))
  tested <- strsplit(effect, ":")[[1]]
  if (length(tested) == 1) {
    cell <- key(setdiff(columns, tested))
    data <- data[ave(as.integer(factor(data[[tested]])), cell, FUN = function(v) length(unique(v))) > 1, ]
    data <- data[ave(as.integer(factor(data[[tested]])), data$observer, FUN = function(v) length(unique(v))) > 1, ]
    if (nrow(data) == 0) return(c(NA, NA))
    contrasts <- sapply(pairs_of(unique(data[[tested]])), function(two) (data[[tested]] == two[1]) - (data[[tested]] == two[2]))
    return(flip_contrasts(data$value, data$observer, contrasts, indicator(key(setdiff(columns, tested)))))
  }
  others <- setdiff(columns, tested)
  a <- data[[tested[1]]]
  b <- data[[tested[2]]]
  contrasts <- NULL
  for (i in pairs_of(unique(a))) for (j in pairs_of(unique(b)))
    contrasts <- cbind(contrasts, ((a == i[1]) - (a == i[2])) * ((b == j[1]) - (b == j[2])))
  if (is.null(contrasts)) return(c(NA, NA))
  if (ncol(contrasts) > 60) contrasts <- indicator(paste(a, b, sep = "\r"))
  flip_contrasts(data$value, data$observer, contrasts,
                 cbind(indicator(key(c(others, tested[1]))), indicator(key(c(others, tested[2])))))
}
if (file.exists(file.path(folder, "factor_effects.csv"))) {
  effects <- read.csv(file.path(folder, "factor_effects.csv"), na.strings = "n/a")
  ours <- t(mapply(effect_of, effects$measure, effects$effect))
  known <- !is.na(ours[, 1])
  hold("factor_effects: statistic", ours[known, 1], effects$statistic[known], 1e-4)
  hold("factor_effects: p", ours[known, 2], effects$p[known], 1e-4)
  hold("factor_effects: p_holm", ave(effects$p, effects$measure, FUN = holm), effects$p_holm, 20 * rounding)
}

print(worst, row.names = FALSE, digits = 3)
quit(status = if (all(worst$holds)) 0 else 1)
