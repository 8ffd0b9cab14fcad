/// A task of two slots whose answers have a truth, for tests of what simulated observers answer.
#pragma once

#include <string_view>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt::test {

inline AnswerKind kind_named(std::string_view name) {
    std::size_t kind = 0;
    while (kinds_of<AnswerKind>[kind].name != name)
        ++kind;
    return static_cast<AnswerKind>(kind);
}

/// Two slots, four levels, an object in each; answers of all kinds that have a truth.
inline Protocol sided() {
    Protocol protocol;
    protocol.slots.resize(2);
    protocol.slots[0].id = "left";
    protocol.slots[1].id = "right";
    protocol.objects.resize(2);
    protocol.objects[0].id = "bust";
    protocol.objects[1].id = "cow";
    for (int i = 0; i < 4; ++i) {
        auto& material = protocol.materials.emplace_back();
        material.id = fmt::format("gold_{}", i);
        material.columns = {{"gloss", fmt::format("{}", i), 1.0 * i}};
    }
    Task task;
    task.id = "judge";
    task.slots = {"left", "right"};
    TaskAnswer which;
    which.id = "which";
    which.kind = kind_named("choice");
    which.choices = {"left", "right"};
    which.keys = {"f", "j"};
    which.truth.by = "gloss";
    which.truth.slope = 0.8;
    which.truth.bias = 0.3;
    which.truth.lapses = 0.1;
    TaskAnswer word = which;
    word.id = "word";
    word.choices = {"matt", "silky", "glossy"};
    word.keys = {"a", "b", "c"};
    word.truth.offset = 1.0;
    TaskAnswer steps;
    steps.id = "steps";
    steps.kind = kind_named("scale");
    steps.steps = 5;
    steps.truth.by = "gloss";
    steps.truth.offset = 1.5;
    steps.truth.gain = 1.0;
    steps.truth.noise = 0.9;
    TaskAnswer right;
    right.id = "right";
    right.kind = kind_named("choice");
    right.choices = {"metal", "stone", "glass"};
    right.keys = {"a", "b", "c"};
    right.correct = "stone";
    right.truth.share_correct = 0.6;
    task.answers = {which, word, steps, right};
    protocol.tasks = {task};
    return protocol;
}

inline Trial trial_of(int index, int left, int right, int object = 0) {
    Trial trial;
    trial.index = index;
    trial.stimulus.material = left;
    trial.stimulus.object = object;
    trial.beside = {{{object, right, 0, 0, 0}, 1}};
    return trial;
}

} // namespace overt::test
