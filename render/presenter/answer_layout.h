/// Answers on the screen: their items from top to bottom, each with its question, and the button that
/// accepts.
#pragma once

#include "render/presenter/answer_parts.h"

namespace overt {

/// All of it, at most `letters.width_px` wide unless a single word is wider; as high as it becomes. It has
/// the same size whatever is typed, chosen and said to be missing.
AnswerDrawing lay_out_answers(const AnswerView& view, const AnswerLetters& letters);

} // namespace overt
