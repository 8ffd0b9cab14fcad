# check.R READERS FOLDER: what readers/overt.R has to read in what tests/readers/run made.
arguments <- commandArgs(trailingOnly = TRUE)
source(file.path(arguments[1], "overt.R"), encoding = "UTF-8")
folder <- arguments[2]
is <- function(...) stopifnot(...)
near <- function(a, b, within = 1e-6) stopifnot(all(abs(a - b) <= within * pmax(1, abs(b))))
raises <- function(text, what) {
  said <- tryCatch({ force(what); "nothing" }, error = conditionMessage)
  if (!grepl(text, said, fixed = TRUE)) stop("\"", said, "\" in place of \"", text, "\"")
}

tables <- read_study(file.path(folder, "tsv"), samples = TRUE)
for (form in c("csv", "jsonl")) {
  other <- read_study(file.path(folder, form), samples = TRUE)
  for (name in c("trials", "answers", "fixations", "samples", "participants", "stimuli"))
    if (!identical(tables[[name]], other[[name]])) stop(form, " ", name, ": ", paste(all.equal(tables[[name]], other[[name]]), collapse = "; "))
  is(identical(tables$units, other$units))
}

# Words stay words, numbers are numbers, what is missing is NA.
is(identical(tables$participants$observer, c("07", "8")))
is(identical(enc2utf8(tables$participants$note), c("=1+1 \\\u00fc", "8\\\u00fc")))
is(nrow(tables$trials) == 4, is.integer(tables$trials$trial), is.numeric(tables$trials$presentation_onset_s), all(is.na(tables$trials$block)))
is(identical(tables$trials$shininess, ifelse(tables$trials$material == "rough", 0.25, 0.75)))
is(tables$units$fixations[["duration_s"]] == "s", tables$units$samples[["surface_x"]] == "mm")
is(tables$dictionary$trials$object$Levels$ball == "B\u00e4llchen")
is(nrow(tables$answers) == 4, !anyNA(tables$answers$answer))

# Fixations have their place, and what their trial showed; each lies where the samples in it do.
fixations <- tables$fixations
is(all(fixations$kind == "fixation"))
is(identical(fixations$material, tables$trials$material[match(paste(fixations$observer, fixations$trial), paste(tables$trials$observer, tables$trials$trial))]))
counted <- fixations[fixations$place %in% "counted", ]
is(nrow(counted) > 5, all(counted$part %in% c("cap", "rest")))
near(sqrt(counted$surface_x^2 + counted$surface_y^2 + counted$surface_z^2), 60, 0.05)
for (i in seq_len(nrow(counted))) {
  row <- counted[i, ]
  within <- subset(tables$samples, observer == row$observer & trial == row$trial & time_s >= row$start_s - 1e-6 & time_s <= row$end_s + 1e-6)
  near(mean(within$x_px, na.rm = TRUE), row$x_px, 1e-3)
}
few <- read_study(file.path(folder, "tsv"), samples = c("x_px", "part"))$samples
is(identical(names(few), c("observer", "session", "trial", "x_px", "part")), nrow(few) == nrow(tables$samples))
is(nrow(tables$table("flips")) == 4 * 60)

# An analysis has the same fixations, and maps whose density times area is the time looked in a trial.
analysis <- read_study(file.path(folder, "analysis"))
is(sum(analysis$fixations$counted) == nrow(counted))
totals <- unlist(lapply(analysis$meshes(), function(mesh) {
  if (is.null(mesh$values$saliency) || any(grepl("difference", mesh$comments))) return(NULL)
  side <- function(corner) mesh$vertices[mesh$faces[, corner], ] - mesh$vertices[mesh$faces[, 1], ]
  u <- side(2); v <- side(3)
  area <- 0.5 * sqrt((u[, 2] * v[, 3] - u[, 3] * v[, 2])^2 + (u[, 3] * v[, 1] - u[, 1] * v[, 3])^2 + (u[, 1] * v[, 2] - u[, 2] * v[, 1])^2)
  sum(area * rowMeans(matrix(mesh$values$saliency[mesh$faces], ncol = 3)))
}))
maps <- subset(analysis$table("maps"), weighting == "duration" & is.na(absent))
for (total in maps$total) is(any(abs(totals - total) < 1e-3 * total))

# Meshes of each form: polygons of three and four corners, a value of each vertex and face.
vertices <- rbind(c(0, 0, 0, 1), c(1, 0, 0, 2), c(1, 1, 0, 3), c(0, 1, -2, 4), c(0.5, 2.25, 300, 255))
faces <- list(c(0, 1, 2, 3), c(3, 2, 4))
parts <- c(-7, 9)
for (form in c("ascii", "binary_little_endian", "binary_big_endian")) {
  file <- file.path(folder, paste0(form, ".ply"))
  write_mesh <- function(cut) {
    to <- rawConnection(raw(), "wb")
    writeBin(charToRaw(sprintf("ply\nformat %s 1.0\ncomment unit mm\nelement vertex 5\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\nelement face 2\nproperty list uchar uint vertex_index\nproperty int part\nend_header\n", form)), to)
    if (form == "ascii") {
      writeBin(charToRaw(paste0(c(apply(vertices, 1, paste, collapse = " "), mapply(function(c, p) paste(length(c), paste(c, collapse = " "), p), faces, parts)), "\n", collapse = "")), to)
    } else {
      endian <- if (form == "binary_big_endian") "big" else "little"
      for (i in 1:5) {
        writeBin(vertices[i, 1], to, size = 4, endian = endian); writeBin(vertices[i, 2], to, size = 8, endian = endian)
        writeBin(as.integer(vertices[i, 3]), to, size = 2, endian = endian); writeBin(as.raw(vertices[i, 4]), to)
      }
      for (i in 1:2) {
        writeBin(as.raw(length(faces[[i]])), to)
        writeBin(as.integer(faces[[i]]), to, size = 4, endian = endian); writeBin(as.integer(parts[i]), to, size = 4, endian = endian)
      }
    }
    bytes <- rawConnectionValue(to); close(to)
    writeBin(bytes[seq_len(length(bytes) - cut)], file)
  }
  write_mesh(0)
  mesh <- read_mesh(file)
  is(all(mesh$vertices == vertices[, 1:3]), identical(lapply(mesh$faces, as.numeric), lapply(faces, `+`, 1)))
  is(all(mesh$values$red == vertices[, 4]), all(mesh$face_values$part == parts), mesh$comments == "unit mm")
  write_mesh(3)
  raises("cut off", read_mesh(file))
}

# What cannot be read is named, with what helps.
raises("there is no such folder", read_study(file.path(folder, "nothing")))
raises("overt export", read_study(file.path(folder, "sessions")))
raises("overt export", read_study(file.path(folder, "cache")))
raises("has no column z_px; it has observer, ", read_study(file.path(folder, "tsv"), samples = "z_px"))
raises("read what `overt export` wrote", read_study(file.path(folder, "analysis"), samples = TRUE))
raises("has no table gauge_settings", tables$table("gauge_settings"))
file <- file.path(folder, "tsv/sub-07_ses-01/trials.tsv")
text <- strsplit(readLines(file), "\t", fixed = TRUE)
text[[2]][3] <- "one"
writeLines(vapply(text, paste, "", collapse = "\t"), file)
raises("trials.tsv:2: trial is \"one\"", read_study(file.path(folder, "tsv")))
writeLines(c(paste(text[[1]], collapse = "\t"), "07\t1"), file)
raises("trials.tsv: ", read_study(file.path(folder, "tsv")))
