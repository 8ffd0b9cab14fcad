#!/usr/bin/env Rscript
# Models of this study's answers, from the table of single answers beside this file: choices, correct answers,
# ratings and response times. Needs R; with lme4 (Debian: r-cran-lme4) and ordinal (r-cran-ordinal) the models
# are mixed ones, and with MLDS (CRAN) difference scales are fitted, too. Without them each observer has a model
# of their own (glm), and coefficients are tested over observers (t).
#
#   Rscript answer_models.R
#
# 1. Choices between two slots: which of them, by the difference of each factor of numbers between them (probit);
#    choices of one of two words: by each factor of numbers (probit); correct answers: by each factor (logit).
# 2. Ratings on steps: cumulative probit (ordinal::clmm), on a line: normal.
# 3. Logarithm of the response time: normal.
#
# Mixed models have random intercepts of observers, and of choices random slopes, too. Writes answer_models.csv
# beside the table: a row for each coefficient. What was left out, and why, is said in the terminal.

table_file <- "{{TABLE}}"

arguments <- commandArgs(trailingOnly = FALSE)
script <- sub("^--file=", "", grep("^--file=", arguments, value = TRUE))
folder <- if (length(script) > 0) dirname(script[1]) else "."
path <- file.path(folder, table_file)
if (!grepl("\\.(csv|tsv)$", table_file) || !file.exists(path)) {
  message(path, ": there is no such table; this script reads csv and tsv (overt analyze --format csv).")
  quit(status = 1)
}
all_answers <- read.table(path, header = TRUE, sep = if (grepl("\\.tsv$", path)) "\t" else ",", quote = "\"",
                          comment.char = "", na.strings = "n/a", check.names = FALSE, stringsAsFactors = FALSE,
                          colClasses = c(observer = "character", value = "character", correct = "character"))
all_answers$observer <- factor(all_answers$observer)

say <- function(...) cat(sprintf(...), "\n", sep = "")
has <- function(package) requireNamespace(package, quietly = TRUE)
has_lme4 <- has("lme4")
if (!has_lme4) say("lme4 is not installed: each observer has a model of their own.")
rows <- NULL

add_rows <- function(what, model, terms, estimates, errors, p, observers, answers) {
  rows <<- rbind(rows, data.frame(of = what, model = model, term = gsub("`", "", terms), estimate = estimates, standard_error = errors,
                                  p = p, observers = observers, answers = answers, row.names = NULL))
}

# One model for each observer; means of their coefficients, with t over observers.
two_stage <- function(what, model, formula, data, fit_one) {
  fits <- lapply(split(data, droplevels(data$observer)), function(own) {
    tryCatch(suppressWarnings(coef(fit_one(formula, own))), error = function(failure) NULL)
  })
  fits <- Filter(function(one) !is.null(one) && all(is.finite(one)), fits)
  if (length(fits) == 0) { say("%s: no observer's answers have a model.", what); return(invisible()) }
  terms <- names(fits[[1]])
  values <- do.call(rbind, lapply(fits, function(one) one[terms]))
  n <- nrow(values)
  errors <- if (n > 1) apply(values, 2, sd) / sqrt(n) else rep(NA, length(terms))
  t <- colMeans(values) / errors
  add_rows(what, paste(model, "of each observer"), terms, colMeans(values), errors,
           if (n > 1) 2 * pt(-abs(t), n - 1) else NA, n, nrow(data))
}

binomial_model <- function(what, link, response, predictors, data) {
  data <- droplevels(data[complete.cases(data[c(response, predictors)]), ])
  if (nrow(data) < 20 || length(unique(data[[response]])) < 2) { say("%s: too few answers for a model.", what); return(invisible()) }
  quoted <- paste0("`", predictors, "`")
  fixed <- paste(c("1", quoted), collapse = " + ")
  if (has_lme4 && nlevels(data$observer) > 2) {
    formula <- as.formula(sprintf("`%s` ~ %s + (%s || observer)", response, fixed, fixed))
    fit <- tryCatch(suppressMessages(suppressWarnings(lme4::glmer(formula, data, family = binomial(link),
                    control = lme4::glmerControl(optimizer = "bobyqa", calc.derivs = FALSE)))), error = function(failure) NULL)
    if (!is.null(fit)) {
      found <- summary(fit)$coefficients
      add_rows(what, paste("mixed,", link), rownames(found), found[, 1], found[, 2], found[, 4], nlevels(data$observer), nrow(data))
      return(invisible())
    }
    say("%s: the mixed model did not converge; each observer has a model of their own.", what)
  }
  two_stage(what, link, as.formula(sprintf("`%s` ~ %s", response, fixed)), data,
            function(formula, own) glm(formula, own, family = binomial(link)))
}

normal_model <- function(what, response, predictors, data) {
  data <- droplevels(data[complete.cases(data[c(response, predictors)]), ])
  if (nrow(data) < 10) { say("%s: too few answers for a model.", what); return(invisible()) }
  fixed <- paste(c("1", if (length(predictors) > 0) paste0("`", predictors, "`")), collapse = " + ")
  if (has_lme4 && nlevels(data$observer) > 2) {
    fit <- suppressMessages(suppressWarnings(lme4::lmer(as.formula(sprintf("`%s` ~ %s + (1 | observer)", response, fixed)), data)))
    found <- summary(fit)$coefficients
    add_rows(what, "mixed, normal", rownames(found), found[, 1], found[, 2], 2 * pnorm(-abs(found[, 3])), nlevels(data$observer), nrow(data))
  } else {
    two_stage(what, "normal", as.formula(sprintf("`%s` ~ %s", response, fixed)), data, function(formula, own) lm(formula, own))
  }
}

ordinal_model <- function(what, predictors, data) {
  data <- droplevels(data[complete.cases(data[c("number", predictors)]), ])
  data$step <- factor(data$number, ordered = TRUE)
  if (!has("ordinal") || nlevels(data$observer) < 3 || nlevels(data$step) < 3 || nlevels(data$step) > 20 || length(predictors) == 0)
    return(normal_model(what, "number", predictors, data))
  fit <- tryCatch(suppressWarnings(ordinal::clmm(as.formula(paste("step ~", paste0("`", predictors, "`", collapse = " + "), "+ (1 | observer)")),
                  data = data, link = "probit")), error = function(failure) NULL)
  if (is.null(fit)) return(normal_model(what, "number", predictors, data))
  found <- summary(fit)$coefficients
  found <- found[seq(nrow(found) - length(fit$beta) + 1, nrow(found)), , drop = FALSE]
  add_rows(what, "mixed, cumulative probit", rownames(found), found[, 1], found[, 2], found[, 4], nlevels(data$observer), nrow(data))
}

# Columns of factors: of whole trials, and of slots.
fixed_columns <- c("observer", "session", "trial", "task", "answer", "item", "kind", "missed", "value", "number", "correct",
                   "is_correct", "response_s")
is_numeric <- function(column) is.numeric(column) && length(unique(na.omit(column))) > 1
varies <- function(column) length(unique(na.omit(column))) > 1 && !anyNA(column)

# Of columns that part the answers alike, such as the ids and the numbers of a series, the numbers alone.
predictors_of <- function(data, columns) {
  columns <- Filter(function(name) varies(data[[name]]), columns)
  columns <- c(Filter(function(name) is_numeric(data[[name]]), columns), Filter(function(name) !is_numeric(data[[name]]), columns))
  chosen <- character(0)
  for (name in columns) {
    part <- as.integer(factor(data[[name]], levels = unique(data[[name]])))
    known <- any(vapply(chosen, function(other) all(part == as.integer(factor(data[[other]], levels = unique(data[[other]])))), TRUE))
    if (!known) chosen <- c(chosen, name)
  }
  chosen
}

key <- paste(all_answers$task, all_answers$answer, ifelse(is.na(all_answers$item), "", all_answers$item), sep = "\r")
for (own in split(all_answers, key)) {
  what <- paste(c(own$task[1], own$answer[1], if (!is.na(own$item[1])) own$item[1]), collapse = ", ")
  own <- own[own$missed == 0, ]
  if (nrow(own) == 0) next
  columns <- setdiff(names(own), fixed_columns)
  of_slots <- grep("^[^.]+\\.", columns, value = TRUE)
  of_trials <- predictors_of(own, setdiff(columns, of_slots))
  slots <- unique(sub("\\..*", "", of_slots))
  choices <- sort(unique(own$value))
  if (own$kind[1] %in% c("choice", "key")) {
    if (length(slots) == 2 && all(choices %in% slots)) {
      factors <- unique(sub("^[^.]+\\.", "", of_slots))
      differences <- character(0)
      for (name in factors) {
        first <- own[[paste(slots[1], name, sep = ".")]]; second <- own[[paste(slots[2], name, sep = ".")]]
        if (is.numeric(first) && is.numeric(second) && any(first != second, na.rm = TRUE)) {
          own[[paste("difference of", name)]] <- first - second
          differences <- c(differences, paste("difference of", name))
        }
      }
      own$chosen_first <- as.integer(own$value == slots[1])
      if (length(differences) > 0) binomial_model(paste0(what, ": ", slots[1], " chosen"), "probit", "chosen_first", differences, own)
    } else if (length(choices) == 2) {
      numbers <- Filter(function(name) is_numeric(own[[name]]), of_trials)
      own$chosen_first <- as.integer(own$value == choices[1])
      if (length(numbers) > 0) binomial_model(paste0(what, ": ", choices[1], " chosen"), "probit", "chosen_first", numbers, own)
    }
    if (any(!is.na(own$is_correct)) && length(of_trials) > 0)
      binomial_model(paste0(what, ": correct"), "logit", "is_correct", of_trials, own)
    # Three or four stimuli in order of a factor: which pair differs more.
    if (has("MLDS") && length(slots) %in% 3:4 && all(choices %in% slots))
      for (name in unique(sub("^[^.]+\\.", "", of_slots))) {
        levels <- as.matrix(own[paste(slots, name, sep = ".")])
        if (!is.numeric(levels) || anyNA(levels)) next
        series <- sort(unique(as.vector(levels)))
        own_level <- levels[cbind(seq_len(nrow(own)), match(own$value, slots))]
        middle <- if (length(slots) == 3) levels[, 2] else levels[cbind(seq_len(nrow(own)), ifelse(match(own$value, slots) < 3, 3, 1))]
        ranks <- t(apply(levels, 1, function(one) match(sort(one), series)))
        keep <- own_level != middle & apply(ranks, 1, function(one) !any(duplicated(one)))
        judged <- data.frame(resp = as.integer(own_level > middle)[keep], S = ranks[keep, , drop = FALSE])
        names(judged) <- c("resp", paste0("S", seq_len(ncol(ranks))))
        fit <- tryCatch(if (ncol(ranks) == 3) MLDS::mlds(MLDS::as.mlbs.df(judged, st = series)) else MLDS::mlds(MLDS::as.mlds.df(judged, st = series)),
                        error = function(failure) NULL)
        if (!is.null(fit)) add_rows(paste0(what, ": difference scale of ", name), "MLDS", as.character(series), fit$pscale / max(fit$pscale), NA, NA,
                                    nlevels(droplevels(own$observer)), nrow(judged))
      }
  }
  if (any(!is.na(own$number))) {
    whole <- all(own$number == round(own$number), na.rm = TRUE)
    if (whole) ordinal_model(paste0(what, ": rating"), of_trials, own) else normal_model(paste0(what, ": number"), "number", of_trials, own)
  }
  if (any(own$response_s > 0, na.rm = TRUE)) {
    own$log_time <- ifelse(own$response_s > 0, log(own$response_s), NA)
    normal_model(paste0(what, ": log response time"), "log_time", of_trials, own)
  }
}
if (is.null(rows)) {
  say("There is no answer that a model is of.")
} else {
  write.csv(rows, file.path(folder, "answer_models.csv"), row.names = FALSE, na = "n/a")
  print(rows, row.names = FALSE, digits = 4)
}
