#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section<ObserverFieldSettings> observer_fields() {
    using F = ObserverFieldSettings;
    return {
        .name = "observer_fields",
        .explanation =
            "Something to be known of the observer. The form is filled in with `--observer-field ID=VALUE`, "
            "or before the session in its window or in the terminal. Standard fields have all but their id "
            "by default: `age` (in years), `sex` (female, male, other), `vision` (normal, corrected to "
            "normal, impaired), `handedness` (left, right, ambidextrous).",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in tables."},
                 &F::id},
                {{.name = "title",
                  .if_left_out = "the standard field's, or the id",
                  .explanation = "What is asked."},
                 &F::title},
                {{.name = "kind",
                  .choices = field_kinds,
                  .if_left_out = "the standard field's, or `\"text\"`",
                  .explanation = "What may stand there."},
                 &F::kind},
                {{.name = "choices",
                  .if_left_out = "the standard field's, or none",
                  .explanation = "Of a choice: what there is to choose from."},
                 &F::choices},
                {{.name = "min",
                  .if_left_out = "the standard field's, or no limit",
                  .explanation = "Of a number: the smallest."},
                 &F::min},
                {{.name = "max",
                  .if_left_out = "the standard field's, or no limit",
                  .explanation = "Of a number: the largest."},
                 &F::max},
                {{.name = "required",
                  .explanation = "Whether a session begins only when the field is filled in."},
                 &F::required},
                {{.name = "note",
                  .if_left_out = "none",
                  .explanation = "Shown while the field is filled in."},
                 &F::note},
            },
        .many = &Protocol::observer_fields};
}

} // namespace overt::key_rows
