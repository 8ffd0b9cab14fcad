#include "experiment/record/tables/shared_columns.h"

#include <utility>

#include "experiment/base/plain_text.h"

namespace overt {

SharedColumns::SharedColumns(const SessionHeader& header)
    : trial{"trial", "Position of the trial in the observer's order, from 1"},
      task{"task", "Which question was asked"}, object{"object", "Which object was shown"},
      material{"material", "In which material it was shown"},
      slot{"slot", "Slot of the screen in which it was; n/a: in none"},
      angle{"angle_deg", "Turn of the object in the frame shown, counter-clockwise seen from above", "deg"},
      has_slots(header.slots.size() > 1) {
    for (const RecordedSlot& entry : header.slots)
        slot.levels.emplace_back(entry.id, plain_line_of(entry.title));
    for (const RecordedTask& entry : header.tasks)
        task.levels.emplace_back(entry.id, plain_line_of(entry.question));
    for (const RecordedObject& entry : header.objects)
        object.levels.emplace_back(entry.id, plain_line_of(entry.title));
    for (const RecordedMaterial& entry : header.materials)
        material.levels.emplace_back(entry.id, plain_line_of(entry.title));
}

TableColumn session_seconds(std::string name, const std::string& meaning) {
    return {std::move(name), meaning + "; session clock, nine decimals keep each nanosecond", "s"};
}

} // namespace overt
