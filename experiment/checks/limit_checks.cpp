#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/design/block_plan.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

/// "block "a" (sequential), block "b" (blocked by stimulus)": those in which a limit of [schedule] is
/// dropped.
std::string blocks_without(const Protocol& protocol, const Factors& factors, const Factor& factor,
                           OrderLimit::Kind kind) {
    std::string blocks;
    for (int index = 0; index < block_count(protocol); ++index) {
        if (!limit_in(protocol, index, factor, kind).is_dropped ||
            levels_in(factors, scope_of(protocol, index), factor).size() < 2)
            continue;
        const BlockSettings& block = block_at(protocol, index);
        blocks +=
            fmt::format("{}block \"{}\" ({}{})", blocks.empty() ? "" : ", ", block.id, name_of(block.order),
                        block.order == OrderMethod::blocked ? fmt::format(" by {}", block.by) : "");
    }
    return blocks;
}

} // namespace

void check_dropped_limits(ProtocolExamination& examination) {
    const Factors factors = factors_of(examination.protocol);
    for (const Factor& factor : factors.all()) {
        if (!can_be_limited(factor))
            continue;
        for (const OrderLimit::Kind kind :
             {OrderLimit::Kind::longest_run, OrderLimit::Kind::least_distance}) {
            const bool is_run = kind == OrderLimit::Kind::longest_run;
            const std::string own = own_limit_key(factor.name, kind),
                              named = fmt::format("{}.{}", is_run ? "max_run" : "min_distance", factor.name),
                              name = examination.is_written("schedule." + named) ? named : own;
            const std::string blocks = blocks_without(examination.protocol, factors, factor, kind);
            if (!blocks.empty() && examination.is_written("schedule." + name))
                examination.warning(
                    {"schedule." + name},
                    fmt::format("this limit does not hold in {}, whose order says otherwise", blocks),
                    fmt::format("write {} in the block itself: a limit to be kept, or 0 if none is meant",
                                name));
        }
    }
}

} // namespace overt
