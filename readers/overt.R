# Reads what overt writes: read_study(FOLDER) gives its tables and meshes. Needs nothing but R 4.
#
# FOLDER is what `overt export SESSION... --out FOLDER` wrote (tsv, csv or jsonl; one session or several), or what `overt
# analyze SESSION... --out FOLDER` wrote. Missing values are NA.
#
#   source("overt.R")
#   study <- read_study("tables")
#   study$trials; study$answers; study$fixations; study$participants; study$stimuli
#   read_study("tables", samples = c("x_px", "y_px", "part"))$samples
#   study$table("steps")                      # any other table of the folder
#   study$units$fixations[["duration_s"]]     # "s"
#   study$meshes()$muse$vertices              # also $faces, $values$saliency

# What of each row says which trial it is of.
overt_row_key <- c("observer", "session", "session_folder", "trial")

overt_stop <- function(...) stop(sprintf(...), call. = FALSE)

# The study in `folder`, as a list:
#   trials        those that count (attempts = TRUE: all), with what they showed
#   answers       what was answered, as it was asked (table given_answers), else the trial's one answer (responses)
#   fixations     with their place on the surface, their part (the areas that they lie in) and what their trial showed
#   samples       NULL unless asked for: TRUE, or the names of the columns that are needed, as samples are many (those
#                 that name a row's trial come with them)
#   participants, stimuli
#   units         by table and column, where it has one
#   dictionary    by table and column: Description, Units, Levels, Format
#   table(name, columns)   any table by the name of its file, without the ending
#   meshes()      by name, those that `overt analyze --meshes` wrote, with the maps as values of their vertices
read_study <- function(folder, samples = FALSE, attempts = FALSE) {
  if (!dir.exists(folder)) overt_stop("%s: there is no such folder", folder)
  parts <- overt_parts(folder, 3)
  if (length(parts) == 0) {
    if (length(list.files(folder, "^session\\.sqlite$", recursive = TRUE)) > 0)
      overt_stop("%s: holds sessions, which R reads no part of: `overt export %s --out tables` writes their tables", folder, folder)
    overt_stop("%s: holds no tables of overt (dictionary.json beside them): give the folder that `overt export` or `overt analyze` wrote", folder)
  }
  parts <- lapply(parts, overt_part)
  dictionary <- new.env()
  rows_of <- function(name, columns = NULL, needed = TRUE) {
    found <- lapply(parts, overt_rows, name = name, columns = columns)
    is_there <- !vapply(found, is.null, TRUE)
    if (!any(is_there)) {
      if (!needed) return(NULL)
      overt_stop("%s: has no table %s; %s", folder, name, if (parts[[1]]$is_analysis)
        "an analysis has no such table: read what `overt export` wrote of its sessions"
        else "export the sessions again with this version of overt")
    }
    for (part in parts[is_there]) dictionary[[name]] <- modifyList(as.list(dictionary[[name]]), overt_columns(part, name))
    overt_bind(found[is_there])
  }
  has <- function(name) any(vapply(parts, function(part) !is.null(overt_file(part, name)), TRUE))
  all_trials <- rows_of("trials")
  study <- list(folder = folder)
  study$trials <- if (attempts) all_trials else overt_counting(all_trials)

  session_of <- function(rows) paste(rows$observer, rows$session, sep = "\r")
  if (has("given_answers")) {
    asked <- overt_counting(rows_of("given_answers"))
    plain <- rows_of("responses", needed = FALSE)
    dictionary[["answers"]] <- modifyList(as.list(dictionary[["responses"]]), dictionary[["given_answers"]])
    study$answers <- if (nrow(asked) == 0) plain else
      overt_bind(list(asked, plain[!session_of(plain) %in% session_of(asked), , drop = FALSE]))
  } else {
    name <- Filter(has, c("answer_trials", "responses"))
    if (length(name) > 0) {
      study$answers <- rows_of(name[1])
      dictionary[["answers"]] <- dictionary[[name[1]]]
    }
  }

  if (has("fixations")) {
    study$fixations <- rows_of("fixations")
  } else {
    fixations <- rows_of("gaze_events")
    fixations <- fixations[fixations$kind == "fixation", , drop = FALSE]
    dictionary[["fixations"]] <- modifyList(dictionary[["trials"]][overt_design_columns(names(all_trials))], dictionary[["gaze_events"]])
    fixations <- overt_join(fixations, rows_of("presentations", needed = FALSE), c(overt_row_key, "slot"))
    study$fixations <- overt_join(fixations, overt_counting(all_trials), overt_row_key)
  }
  study$participants <- rows_of("participants", needed = FALSE)
  study$stimuli <- rows_of("stimuli", needed = FALSE)
  study$samples <- if (!identical(samples, FALSE)) rows_of("samples", if (isTRUE(samples)) NULL else samples)
  study$table <- function(name, columns = NULL) rows_of(name, columns)
  study$meshes <- function() {
    files <- unlist(lapply(parts, function(part) list.files(file.path(part$folder, "meshes"), "\\.ply$", full.names = TRUE)))
    files <- files[!duplicated(basename(files))]
    setNames(lapply(files, read_mesh), sub("\\.ply$", "", basename(files)))
  }
  study$dictionary <- as.list(dictionary)
  study$units <- lapply(study$dictionary, function(columns) unlist(lapply(columns, function(what) what$Units)))
  study
}

overt_counting <- function(rows) if (is.null(rows$counts)) rows else rows[!rows$counts %in% "no", , drop = FALSE]

# What a trial showed stands between its question and how it ended; a presentation says its slot's.
overt_design_columns <- function(columns) {
  if (!"task" %in% columns) return(if ("slot" %in% columns) columns[seq_along(columns) > match("slot", columns)] else character())
  end <- match(c("status", "excluded"), columns)
  end <- if (all(is.na(end))) length(columns) + 1 else min(end, na.rm = TRUE)
  columns[seq_along(columns) >= match("task", columns) & seq_along(columns) < end]
}

# The rows, with the columns of what `shown` says that they have not; none is lost or doubled.
overt_join <- function(rows, shown, key) {
  if (is.null(shown)) return(rows)
  shown <- overt_counting(shown)
  key <- intersect(intersect(key, names(rows)), names(shown))
  name_of <- function(table) do.call(paste, c(lapply(table[key], as.character), sep = "\r"))
  at <- match(name_of(rows), name_of(shown))
  for (column in setdiff(overt_design_columns(names(shown)), names(rows))) rows[[column]] <- shown[[column]][at]
  rows
}

# One below the other; what a table has not is NA there.
overt_bind <- function(tables) {
  tables <- Filter(function(table) !is.null(table), tables)
  columns <- unique(unlist(lapply(tables, names)))
  tables <- lapply(tables, function(table) {
    for (column in setdiff(columns, names(table))) table[[column]] <- rep(NA, nrow(table))
    table[columns]
  })
  rows <- do.call(rbind, tables)
  rownames(rows) <- NULL
  rows
}

# The folders with tables, in the order of their names.
overt_parts <- function(folder, depth) {
  if (file.exists(file.path(folder, "dictionary.json"))) return(folder)
  if (depth == 0) return(character())
  unlist(lapply(sort(list.dirs(folder, recursive = FALSE), method = "radix"), overt_parts, depth = depth - 1))
}

overt_part <- function(folder) {
  file <- file.path(folder, "dictionary.json")
  dictionary <- tryCatch(overt_json(readLines(file, encoding = "UTF-8", warn = FALSE)),
                         error = function(reason) overt_stop("%s: is damaged: write the tables again", file))
  list(folder = folder, is_analysis = is.null(dictionary$Files), files = if (is.null(dictionary$Files)) dictionary else dictionary$Files)
}

overt_file <- function(part, name) {
  files <- file.path(part$folder, paste0(name, c(".tsv", ".csv", ".jsonl")))
  files <- files[file.exists(files)]
  if (length(files) > 0) files[1]
}

overt_columns <- function(part, name) {
  file <- overt_file(part, name)
  if (is.null(file)) list() else as.list(part$files[[basename(file)]]$Columns)
}

overt_rows <- function(part, name, columns = NULL) {
  file <- overt_file(part, name)
  if (is.null(file)) return(NULL)
  cells <- overt_cells(file)
  absent <- setdiff(columns, names(cells))
  if (length(absent) > 0 && ncol(cells) > 0) overt_stop("%s: has no column %s; it has %s", file, absent[1], paste(names(cells), collapse = ", "))
  if (!is.null(columns)) cells <- cells[names(cells) %in% c(overt_row_key, columns)]
  dictionary <- overt_columns(part, name)
  for (column in names(cells)) cells[[column]] <- overt_cast(cells[[column]], dictionary[[column]], file, column)
  cells
}

overt_cast <- function(texts, what, file, column) {
  form <- what$Format
  if (is.null(form)) # written by an earlier version
    form <- if (!is.null(what$Units)) "number" else if (!is.null(what$Levels) || column == "observer") "string" else "either"
  if (form == "string") return(texts)
  numbers <- suppressWarnings(as.numeric(texts))
  wrong <- which(is.na(numbers) & !is.na(texts))
  if (length(wrong) > 0) {
    if (form == "either") return(texts)
    overt_stop("%s:%d: %s is \"%s\", and no number as dictionary.json says: the file was changed; write the tables again",
               file, wrong[1] + 1, column, texts[wrong[1]])
  }
  is_whole <- form == "integer" && all(abs(numbers) <= .Machine$integer.max, na.rm = TRUE)
  if (is_whole) as.integer(numbers) else numbers
}

# Texts, missing ones NA, under the names of their columns.
overt_cells <- function(file) {
  if (endsWith(file, ".jsonl")) {
    lines <- readLines(file, encoding = "UTF-8", warn = FALSE)
    if (length(lines) == 0) return(data.frame())
    # Each line is one object of plain values: name, colon, value, comma.
    tokens <- regmatches(lines, gregexpr(overt_json_token, lines, perl = TRUE))
    columns <- tryCatch(names(overt_json(lines[1])), error = function(reason) NULL)
    wrong <- which(lengths(tokens) != max(1, length(columns)) * 4 + 1)
    if (length(wrong) > 0) overt_stop("%s:%d: is no JSON: write the tables again", file, wrong[1])
    columns <- vapply(tokens[[1]][seq(2, by = 4, length.out = length(columns))], overt_json_text, "")
    texts <- matrix(unlist(lapply(tokens, function(of) of[seq(4, by = 4, to = length(of))])), ncol = length(columns), byrow = TRUE)
    texts[texts == "null"] <- NA
    is_text <- startsWith(texts, "\"") & !is.na(texts)
    texts[is_text] <- overt_json_text(texts[is_text])
    return(setNames(as.data.frame(texts, stringsAsFactors = FALSE), columns))
  }
  is_csv <- endsWith(file, ".csv")
  cells <- tryCatch(
    read.table(file, header = TRUE, sep = if (is_csv) "," else "\t", quote = if (is_csv) "\"" else "", colClasses = "character",
               na.strings = "n/a", comment.char = "", check.names = FALSE, encoding = "UTF-8", fill = FALSE),
    error = function(reason) overt_stop("%s: %s: the file was cut off or changed; write the tables again", file, conditionMessage(reason)))
  for (column in names(cells)) {
    text <- cells[[column]]
    Encoding(text) <- "UTF-8"
    if (!is_csv && any(grepl("\\", text, fixed = TRUE))) text <- overt_unescaped(text)
    # The apostrophe that keeps a spreadsheet from taking a text for a formula.
    guarded <- grepl("^'[-=+@\t\r].", text)
    text[guarded] <- substring(text[guarded], 2)
    cells[[column]] <- text
  }
  cells
}

overt_unescaped <- function(texts) {
  # A byte that no text holds stands for a backslash meanwhile.
  texts <- gsub("\\\\", "\001", texts, fixed = TRUE)
  for (pair in list(c("\\t", "\t"), c("\\n", "\n"), c("\\r", "\r"))) texts <- gsub(pair[1], pair[2], texts, fixed = TRUE)
  gsub("\001", "\\", texts, fixed = TRUE)
}

overt_json_token <- "\"[^\"\\\\]*+(?:\\\\.[^\"\\\\]*+)*+\"|[-+0-9.eE]+|true|false|null|[][{}:,]"

# Texts without their quotes.
overt_json_text <- function(texts) {
  texts <- substring(texts, 2, nchar(texts) - 1)
  if (!any(grepl("\\", texts, fixed = TRUE))) return(texts)
  texts <- gsub("\\\\", "\001", texts, fixed = TRUE)
  for (pair in list(c("\\\"", "\""), c("\\/", "/"), c("\\n", "\n"), c("\\t", "\t"), c("\\r", "\r"), c("\\b", "\b"), c("\\f", "\f")))
    texts <- gsub(pair[1], pair[2], texts, fixed = TRUE)
  codes <- unique(unlist(regmatches(texts, gregexpr("(?:\\\\u[0-9a-fA-F]{4})++", texts, perl = TRUE))))
  for (code in codes) {
    units <- strtoi(strsplit(code, "\\u", fixed = TRUE)[[1]][-1], 16L)
    bytes <- as.raw(rbind(units %/% 256L, units %% 256L))
    texts <- gsub(code, iconv(list(bytes), "UTF-16BE", "UTF-8")[[1]], texts, fixed = TRUE)
  }
  gsub("\001", "\\", texts, fixed = TRUE)
}

# Lines of JSON as lists; no text goes on over a line's end.
overt_json <- function(lines) {
  tokens <- unlist(regmatches(lines, gregexpr(overt_json_token, lines, perl = TRUE)))
  at <- 0
  take <- function() tokens[at <<- at + 1]
  value <- function() {
    token <- take()
    if (is.na(token)) stop("cut off")
    if (token == "{") {
      names <- character(); values <- list()
      while ((name <- take()) != "}") {
        if (name == ",") next
        if (take() != ":") stop("a colon is missing")
        names <- c(names, overt_json_text(name))
        values[length(values) + 1] <- list(value())
      }
      setNames(values, names)
    } else if (token == "[") {
      values <- list()
      while (tokens[at + 1] != "]") if (tokens[at + 1] == ",") take() else values[length(values) + 1] <- list(value())
      take()
      values
    } else if (substr(token, 1, 1) == "\"") overt_json_text(token)
    else if (token == "null") NULL
    else if (token %in% c("true", "false")) token == "true"
    else as.numeric(token)
  }
  value()
}

overt_ply_types <- list(char = c(1, 1), int8 = c(1, 1), uchar = c(1, 0), uint8 = c(1, 0), short = c(2, 1), int16 = c(2, 1),
  ushort = c(2, 0), uint16 = c(2, 0), int = c(4, 1), int32 = c(4, 1), uint = c(4, 0), uint32 = c(4, 0),
  float = c(4, 2), float32 = c(4, 2), double = c(8, 2), float64 = c(8, 2)) # bytes; 0 unsigned, 1 signed, 2 not whole

# The mesh in a PLY file (ascii or binary): vertices (a matrix of x, y, z), faces (a matrix of the numbers of their
# vertices, from 1; of faces with different numbers of corners a list), values and face_values (data frames by name,
# such as saliency, the density of a map), comments (what the file says of itself, its legend).
read_mesh <- function(file) {
  if (!file.exists(file)) overt_stop("%s: there is no such file", file)
  bytes <- readBin(file, "raw", file.size(file))
  end <- grepRaw("end_header\r?\n", bytes)
  if (length(end) == 0 || !identical(bytes[1:3], charToRaw("ply")))
    overt_stop("%s: is no PLY file: meshes with maps are written by `overt analyze --meshes`", file)
  head <- rawToChar(bytes[seq_len(end - 1)])
  Encoding(head) <- "UTF-8"
  lines <- strsplit(sub("\r$", "", strsplit(head, "\n", fixed = TRUE)[[1]]), " +")
  form <- ""; comments <- character(); elements <- list()
  for (words in lines[-1]) {
    last <- length(elements)
    if (words[1] == "format") form <- words[2]
    else if (words[1] == "comment") comments <- c(comments, paste(words[-1], collapse = " "))
    else if (words[1] == "element") elements[[last + 1]] <- list(name = words[2], count = as.integer(words[3]), properties = list())
    else if (words[1] == "property")
      elements[[last]]$properties[[words[length(words)]]] <- list(is_list = words[2] == "list",
        types = overt_ply_types[setdiff(words[2:(length(words) - 1)], "list")])
  }
  body <- bytes[-seq_len(end - 1 + match(as.raw(10), bytes[seq(end, length(bytes))]))]
  damaged <- function(reason) overt_stop("%s: is cut off, or no PLY of a known form (%s): write it again", file, form)
  tables <- tryCatch(switch(form, ascii = overt_ply_texts(body, elements), binary_little_endian = overt_ply_bytes(body, elements, "little"),
    binary_big_endian = overt_ply_bytes(body, elements, "big"), stop("form")), error = damaged, warning = damaged)
  vertex <- tables$vertex; face <- tables$face
  corners <- intersect(c("vertex_indices", "vertex_index"), names(face))
  faces <- if (length(corners) > 0) face[[corners[1]]]
  list(vertices = do.call(cbind, vertex[c("x", "y", "z")]), faces = if (is.list(faces)) lapply(faces, `+`, 1) else faces + 1,
       values = as.data.frame(vertex[setdiff(names(vertex), c("x", "y", "z"))]),
       face_values = as.data.frame(face[setdiff(names(face), corners)]), comments = comments)
}

overt_ply_texts <- function(body, elements) {
  numbers <- scan(text = rawToChar(body), quiet = TRUE)
  at <- 0
  tables <- list()
  for (element in elements) {
    columns <- lapply(element$properties, function(property) vector("list", element$count))
    for (row in seq_len(element$count)) for (name in names(columns)) {
      length <- 1
      if (element$properties[[name]]$is_list) { length <- numbers[at + 1]; at <- at + 1 }
      columns[[name]][[row]] <- numbers[at + seq_len(length)]
      at <- at + length
    }
    tables[[element$name]] <- lapply(columns, overt_ply_column)
  }
  if (anyNA(numbers) || at > length(numbers)) stop("cut off")
  tables
}

# One value in each row: a vector; several, as many in each: a matrix with a row for each; else the list.
overt_ply_column <- function(rows) {
  lengths <- unique(lengths(rows))
  if (length(lengths) != 1) return(rows)
  values <- unlist(rows)
  if (lengths == 1) values else matrix(values, ncol = lengths, byrow = TRUE)
}

overt_ply_bytes <- function(body, elements, endian) {
  at <- 0
  numbers <- function(raw, type, count) {
    if (length(raw) < type[1] * count) stop("cut off")
    if (type[2] == 2) return(readBin(raw, "double", count, type[1], endian = endian))
    whole <- readBin(raw, "integer", count, type[1], signed = type[2] == 1 || type[1] > 2, endian = endian)
    if (type[2] == 0 && type[1] == 4) ifelse(whole < 0, whole + 2^32, whole) else whole
  }
  tables <- list()
  for (element in elements) {
    columns <- list()
    if (element$count > 0) {
      # Rows of one length each, such as triangles, are read at once: a column of bytes for each row of the first's length.
      fields <- list(); size <- 0
      for (name in names(element$properties)) {
        property <- element$properties[[name]]
        length <- 1
        if (property$is_list) {
          type <- property$types[[1]]
          length <- numbers(body[at + size + seq_len(type[1])], type, 1)
          fields[[length(fields) + 1]] <- list(name = NULL, from = size, type = type, length = 1, is = length)
          size <- size + type[1]
        }
        type <- property$types[[length(property$types)]]
        fields[[length(fields) + 1]] <- list(name = name, from = size, type = type, length = length)
        size <- size + type[1] * length
      }
      if (at + size * element$count <= length(body)) {
        rows <- matrix(body[at + seq_len(size * element$count)], nrow = size)
        is_even <- TRUE
        for (field in fields) {
          values <- numbers(as.vector(rows[field$from + seq_len(field$type[1] * field$length), ]), field$type, field$length * element$count)
          if (is.null(field$name)) is_even <- is_even && all(values == field$is)
          else columns[[field$name]] <- if (field$length == 1) values else matrix(values, ncol = field$length, byrow = TRUE)
        }
      } else is_even <- FALSE
      if (is_even) at <- at + size * element$count
      else {
        columns <- lapply(element$properties, function(property) vector("list", element$count))
        for (row in seq_len(element$count)) for (name in names(columns)) {
          types <- element$properties[[name]]$types
          length <- 1
          if (element$properties[[name]]$is_list) {
            length <- numbers(body[at + seq_len(types[[1]][1])], types[[1]], 1)
            at <- at + types[[1]][1]
          }
          type <- types[[length(types)]]
          if (at + type[1] * length > length(body)) stop("cut off")
          columns[[name]][[row]] <- numbers(body[at + seq_len(type[1] * length)], type, length)
          at <- at + type[1] * length
        }
        columns <- lapply(columns, overt_ply_column)
      }
    }
    tables[[element$name]] <- columns
  }
  tables
}
