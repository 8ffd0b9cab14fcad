#include "experiment/study/results/answer_rows.h"

namespace overt {

bool is_choice(const StudyAnswer& answer) {
    return !answer.is_missed && !answer.number && answer.kind != "text" && answer.kind != "spoken" &&
           answer.kind != "point" && answer.kind != "gauge";
}

bool is_rating(const StudyAnswer& answer) {
    return answer.number && answer.kind != "match" && answer.kind != "gauge";
}

} // namespace overt
