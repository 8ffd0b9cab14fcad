#!/usr/bin/env Rscript
# Mixed models of this study, from the table of trials beside this file: needs R with lme4 (Debian: r-cran-lme4).
#
#   Rscript mixed_models.R [--slopes] [--bootstrap N]
#
# 1. Fixations on the area below among all counted ones of a trial: binomial, logit link.
# 2. Logarithm of the mean within-cluster sum of squares (WSS, mm^2) of a trial: normal.
#
# Fixed effects: the factors below and their interactions in pairs (sum contrasts, so that a main effect is one over
# the mean of the other factors). Random intercepts: of observers, of objects, and of each observer at each level of
# a factor (observer:task); without the last a difference that observers have among themselves would pass for one
# of the factor (Barr, Levy, Scheepers and Tily 2013, Journal of Memory and Language 68, 255-278). The binomial model
# also has one of each trial, for the fixations of a trial depend on each other. Terms are tested by the likelihood
# ratio of the models with and without them (chi-squared; for main effects, both without interactions). With few
# observers chi-squared is too small a yardstick: hold p against factor_effects, whose permutations need no model, or
# ask for the parametric bootstrap: with --bootstrap N data are drawn N times from the model without the term, both models
# are fitted to them, and p_bootstrap is the share that differ as much, the observed data among them (some minutes).
# With --slopes observers differ in the effects of factors with all their correlations, (1 + factor | observer), the
# maximal model of Barr et al., in place of the intercepts observer:factor. Where such a model is singular, that is said:
# then the data cannot tell so many variances apart, and the model with intercepts alone is the sounder one.
# Writes mixed_models_coefficients.csv and mixed_models_tests.csv beside the table, and what was left out, and why,
# to the terminal.

factors <- strsplit("{{FACTORS}}", ",", fixed = TRUE)[[1]]
area <- "{{AREA}}" # of the surface; empty: there is none
table_file <- "{{TABLE}}"

given <- commandArgs(trailingOnly = TRUE)
has_slopes <- "--slopes" %in% given
bootstraps <- 0
if ("--bootstrap" %in% given) {
  bootstraps <- suppressWarnings(as.integer(given[match("--bootstrap", given) + 1]))
  if (is.na(bootstraps) || bootstraps < 1) {
    message("--bootstrap takes a whole number, such as 500")
    quit(status = 2)
  }
}
unknown <- setdiff(given, c("--slopes", "--bootstrap", as.character(bootstraps)))
if (length(unknown) > 0) {
  message("there is no option ", unknown[1], ": --slopes and --bootstrap N are there")
  quit(status = 2)
}

arguments <- commandArgs(trailingOnly = FALSE)
script <- sub("^--file=", "", grep("^--file=", arguments, value = TRUE))
folder <- if (length(script) > 0) dirname(script[1]) else "."

if (!requireNamespace("lme4", quietly = TRUE)) {
  message("lme4 is not installed: install.packages(\"lme4\"), or on Debian apt install r-cran-lme4.")
  quit(status = 1)
}
suppressPackageStartupMessages(library(lme4))

path <- file.path(folder, table_file)
if (!grepl("\\.(csv|tsv)$", table_file) || !file.exists(path)) {
  message(path, ": there is no such table; this script reads csv and tsv (overt analyze --format csv).")
  quit(status = 1)
}
trials <- read.table(path, header = TRUE, sep = if (grepl("\\.tsv$", path)) "\t" else ",", quote = "\"",
                     comment.char = "", na.strings = "n/a", check.names = FALSE,
                     colClasses = c(observer = "character"))
trials <- trials[trials$excluded == 0, ]
for (column in c("observer", "object", intersect(factors, names(trials))))
  trials[[column]] <- factor(trials[[column]])
trials$trial_of_all <- factor(seq_len(nrow(trials)))

say <- function(...) cat(sprintf(...), "\n", sep = "")
quoted <- function(names) paste0("`", names, "`")

fit_all <- function(what, response, data, is_binomial) {
  data <- droplevels(data)
  used <- Filter(function(name) name %in% names(data) && nlevels(data[[name]]) > 1, factors)
  left_out <- setdiff(factors, used)
  if (length(left_out) > 0) say("%s: %s has a single level, and is left out.", what, paste(left_out, collapse = ", "))
  groups <- setdiff(Filter(function(name) nlevels(data[[name]]) > 1, c("observer", "object")), used)
  if (!"observer" %in% groups || nrow(data) < 10) {
    say("%s: there are too few observers or trials (%d) for a model.", what, nrow(data))
    return(NULL)
  }
  random <- quoted(c(groups, if (is_binomial) "trial_of_all"))
  varied <- character(0)
  for (name in used) {
    # What differs between observers alone is in their own intercept; what each trial has alone, in its noise.
    cells <- nlevels(interaction(data$observer, data[[name]], drop = TRUE))
    if (cells > nlevels(data$observer) && cells < nrow(data)) varied <- c(varied, quoted(name))
    contrasts(data[[name]]) <- contr.sum(nlevels(data[[name]]))
  }
  if (has_slopes && length(varied) > 0) {
    random <- paste0("(1 | ", setdiff(random, "`observer`"), ")")
    random <- c(paste0("(1 + ", paste(varied, collapse = " + "), " | observer)"), random[random != "(1 | )"])
  } else {
    random <- paste0("(1 | ", c(random, if (length(varied) > 0) paste0("observer:", varied)), ")")
  }
  random <- paste0(random, collapse = " + ")
  fit <- function(fixed) {
    formula <- as.formula(paste(response, "~", if (length(fixed) > 0) paste(fixed, collapse = " + ") else "1", "+", random))
    control <- if (is_binomial) glmerControl(optimizer = "bobyqa", optCtrl = list(maxfun = 1e5), calc.derivs = FALSE)
               else lmerControl(optimizer = "bobyqa", calc.derivs = FALSE)
    suppressMessages(if (is_binomial) glmer(formula, data, family = binomial, control = control)
                     else lmer(formula, data, REML = FALSE, control = control))
  }
  main <- quoted(used)
  interactions <- if (length(used) > 1) combn(main, 2, paste, collapse = ":") else character(0)
  full <- fit(c(main, interactions))
  if (isSingular(full))
    say("%s: the fit is singular: a random effect is estimated as 0%s.", what,
        if (has_slopes) ", or two as one; prefer the model without --slopes" else "")
  if (!identical(as.integer(full@optinfo$conv$opt), 0L)) say("%s: the fit did not come to an end: do not rely on it.", what)
  rows <- summary(full)$coefficients
  coefficients <- data.frame(model = what, term = rownames(rows), estimate = rows[, 1], standard_error = rows[, 2],
                             row.names = NULL)
  compare <- function(term, with, without) {
    difference <- max(2 * as.numeric(logLik(with) - logLik(without)), 0)
    df <- attr(logLik(with), "df") - attr(logLik(without), "df")
    row <- data.frame(model = what, term = gsub("`", "", term), chi_squared = difference, df = df,
                      p = if (df > 0) pchisq(difference, df, lower.tail = FALSE) else NA)
    if (bootstraps > 0) {
      drawn <- simulate(without, nsim = bootstraps, seed = 1)
      differences <- vapply(seq_len(bootstraps), function(i) tryCatch(
        suppressWarnings(suppressMessages(max(2 * as.numeric(logLik(refit(with, drawn[[i]])) - logLik(refit(without, drawn[[i]]))), 0))),
        error = function(e) NA_real_), 0)
      kept <- differences[!is.na(differences)]
      # Fits end where their steps become small, so that equal ones differ a little.
      row$p_bootstrap <- (1 + sum(kept >= difference - 1e-6)) / (1 + length(kept))
      row$bootstraps <- length(kept)
    }
    row
  }
  tests <- NULL
  additive <- if (length(interactions) > 0) fit(main) else full
  for (term in main) tests <- rbind(tests, compare(term, additive, fit(setdiff(main, term))))
  for (term in interactions) tests <- rbind(tests, compare(term, full, fit(c(main, setdiff(interactions, term)))))
  say("%s: %d trials, %d observers; random effects %s.", what, nrow(data), nlevels(data$observer),
      gsub("`", "", random))
  print(tests, row.names = FALSE)
  list(coefficients = coefficients, tests = tests)
}

trials$on_area <- if (nzchar(area)) trials[[paste0("on_", area)]] else NA
looks <- trials[!is.na(trials$on_area) & trials$fixations > 0, ]
spread <- trials[!is.na(trials$wss_mm2) & trials$wss_mm2 > 0, ]
models <- list(if (nzchar(area)) fit_all(paste("share on", area), "cbind(on_area, fixations - on_area)", looks, TRUE),
               fit_all("log WSS", "log(wss_mm2)", spread, FALSE))
models <- Filter(Negate(is.null), models)
for (what in c("coefficients", "tests")) {
  rows <- do.call(rbind, lapply(models, `[[`, what))
  if (!is.null(rows))
    write.csv(rows, file.path(folder, paste0("mixed_models_", what, ".csv")), row.names = FALSE, na = "n/a")
}
