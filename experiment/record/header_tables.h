/// The columns of the header's wide tables.
#pragma once

#include "experiment/record/row_table.h"
#include "experiment/record/session_header.h"

namespace overt {

RowTable<SessionHeader> session_table();
RowTable<RecordedCharacterisation> characterisation_table();
RowTable<RecordedObject> object_table();
/// By motion.
RowTable<Animation> animation_table();

} // namespace overt
