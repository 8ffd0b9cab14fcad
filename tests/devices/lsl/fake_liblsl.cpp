#include "tests/devices/lsl/fake_liblsl.h"

#include <chrono>
#include <cstdint>
#include <cstdio>

using overt::test::FakeLsl;
using overt::test::FakeStream;
using overt::test::FakeXml;

namespace {

using Info = std::shared_ptr<FakeStream>;

/// By this search; counts it.
bool is_heard(FakeStream& stream) { return stream.unheard == 0 || stream.unheard-- <= 0; }

std::string words_of(const char* word) { return word; }
std::string words_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", number);
    return text;
}
/// Under the lock.
template <class... Word> void note(FakeLsl& fake, const Word&... words) {
    std::string all;
    ((all += (all.empty() ? "" : " ") + words_of(words)), ...);
    fake.asked.push_back(all);
}

FakeXml& nowhere() {
    static FakeXml empty;
    return empty;
}

} // namespace

extern "C" {

#define LSL_CALL __attribute__((visibility("default")))

LSL_CALL FakeLsl* fake_lsl() {
    static FakeLsl fake;
    return &fake;
}
LSL_CALL double lsl_local_clock() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
LSL_CALL std::int32_t lsl_library_version() { return 116; }

#ifndef FAKE_LSL_BROKEN
/// As the real one: what has answered once there are `minimum`, in the order of the answers, and no more.
LSL_CALL std::int32_t lsl_resolve_byprop(Info** buffer, std::uint32_t size, const char* property,
                                         const char* value, std::int32_t minimum, double timeout_s) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "resolve", property, value, minimum, timeout_s, size);
    const auto property_of = [name = std::string(property)](const FakeStream& stream) {
        return name == "name"        ? stream.name
               : name == "type"      ? stream.type
               : name == "source_id" ? stream.source
               : name == "hostname"  ? stream.host
                                     : stream.uid;
    };
    std::uint32_t count = 0;
    for (const Info& stream : fake_lsl()->network)
        if (property_of(*stream) == value && is_heard(*stream) && count < size &&
            static_cast<std::int32_t>(count) < minimum) {
            buffer[count++] = new Info(stream);
            ++fake_lsl()->infos;
        }
    return static_cast<std::int32_t>(count);
}
#endif
LSL_CALL std::int32_t lsl_resolve_all(Info** buffer, std::uint32_t size, double timeout_s) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "resolve all", timeout_s, size);
    std::uint32_t count = 0;
    for (const Info& stream : fake_lsl()->network)
        if (is_heard(*stream) && count < size) {
            buffer[count++] = new Info(stream);
            ++fake_lsl()->infos;
        }
    return static_cast<std::int32_t>(count);
}
LSL_CALL Info* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels,
                                     double rate_hz, std::int32_t format, const char* source) {
    auto stream = std::make_shared<FakeStream>();
    stream->name = name;
    stream->type = type;
    stream->channels = channels;
    stream->rate_hz = rate_hz;
    stream->format = format;
    stream->source = source;
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "info", name, type, channels, rate_hz, format, source);
    if (fake_lsl()->refused == "info")
        return nullptr;
    ++fake_lsl()->infos;
    return new Info(std::move(stream));
}
LSL_CALL void lsl_destroy_streaminfo(Info* info) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    --fake_lsl()->infos;
    delete info;
}
LSL_CALL const char* lsl_get_name(Info* info) { return (*info)->name.c_str(); }
LSL_CALL const char* lsl_get_type(Info* info) { return (*info)->type.c_str(); }
LSL_CALL const char* lsl_get_source_id(Info* info) { return (*info)->source.c_str(); }
LSL_CALL const char* lsl_get_hostname(Info* info) { return (*info)->host.c_str(); }
LSL_CALL const char* lsl_get_uid(Info* info) { return (*info)->uid.c_str(); }
LSL_CALL std::int32_t lsl_get_channel_count(Info* info) { return (*info)->channels; }
LSL_CALL std::int32_t lsl_get_channel_format(Info* info) { return (*info)->format; }
LSL_CALL double lsl_get_nominal_srate(Info* info) { return (*info)->rate_hz; }

LSL_CALL FakeXml* lsl_get_desc(Info* info) { return &(*info)->desc; }
LSL_CALL FakeXml* lsl_child(FakeXml* xml, const char* name) {
    for (FakeXml& each : xml->children)
        if (each.name == name)
            return &each;
    return &nowhere();
}
LSL_CALL FakeXml* lsl_next_sibling_n(FakeXml* xml, const char* name) {
    bool is_past = false;
    for (FakeXml& each : xml->parent->children) {
        if (is_past && each.name == name)
            return &each;
        is_past = is_past || &each == xml;
    }
    return &nowhere();
}
LSL_CALL std::int32_t lsl_empty(FakeXml* xml) { return xml == &nowhere() ? 1 : 0; }
LSL_CALL const char* lsl_child_value_n(FakeXml* xml, const char* name) {
    return lsl_child(xml, name)->text.c_str();
}
LSL_CALL FakeXml* lsl_append_child(FakeXml* xml, const char* name) { return &xml->add(name); }
LSL_CALL FakeXml* lsl_append_child_value(FakeXml* xml, const char* name, const char* value) {
    return &xml->add(name, value);
}

LSL_CALL Info* lsl_create_inlet(Info* info, std::int32_t buffered_s, std::int32_t chunk,
                                std::int32_t recover) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "inlet", buffered_s, chunk, recover);
    if (fake_lsl()->refused == "inlet")
        return nullptr;
    ++fake_lsl()->inlets;
    return new Info(*info);
}
LSL_CALL void lsl_destroy_inlet(Info* inlet) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    --fake_lsl()->inlets;
    delete inlet;
}
LSL_CALL Info* lsl_get_fullinfo(Info* inlet, double timeout_s, std::int32_t* error) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "full info", timeout_s);
    *error = (*inlet)->answers ? 0 : -1;
    if (!(*inlet)->answers)
        return nullptr;
    ++fake_lsl()->infos;
    return new Info(*inlet);
}
LSL_CALL void lsl_open_stream(Info* inlet, double timeout_s, std::int32_t* error) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "open", timeout_s);
    *error = (*inlet)->is_lost ? -2 : (*inlet)->open_error.load();
    (*inlet)->is_open = true;
}
LSL_CALL double lsl_pull_sample_d(Info* inlet, double* values, std::int32_t count, double timeout_s,
                                  std::int32_t* error) {
    std::unique_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "pull", count, timeout_s);
    FakeStream& stream = **inlet;
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
    while (stream.waiting.empty() && !stream.is_lost && std::chrono::steady_clock::now() < until)
        fake_lsl()->fed.wait_until(lock, until);
    *error = stream.is_lost ? -2 : 0;
    if (stream.waiting.empty() || stream.is_lost)
        return 0.0;
    const FakeStream::Sample sample = std::move(stream.waiting.front());
    stream.waiting.pop_front();
    for (std::int32_t i = 0; i < count; ++i)
        values[i] = sample.values.at(static_cast<std::size_t>(i));
    return sample.time_s;
}
LSL_CALL double lsl_time_correction(Info* inlet, double timeout_s, std::int32_t* error) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "correction", timeout_s);
    *error = (*inlet)->is_lost ? -2 : (*inlet)->correction_error.load();
    return (*inlet)->correction_s;
}
#ifndef FAKE_LSL_OLD
LSL_CALL double lsl_time_correction_ex(Info* inlet, double* remote_s, double* uncertainty_s, double timeout_s,
                                       std::int32_t* error) {
    const double correction_s = lsl_time_correction(inlet, timeout_s, error);
    const std::scoped_lock lock(fake_lsl()->mutex);
    // Measured in the background, some time ago.
    *remote_s = lsl_local_clock() - 1.5 - correction_s;
    *uncertainty_s = (*inlet)->uncertainty_s;
    return correction_s;
}
#endif

LSL_CALL Info* lsl_create_outlet(Info* info, std::int32_t chunk, std::int32_t buffered_s) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "outlet", chunk, buffered_s);
    if (fake_lsl()->refused == "outlet")
        return nullptr;
    ++fake_lsl()->outlets;
    fake_lsl()->sent.push_back(*info);
    return new Info(*info);
}
LSL_CALL void lsl_destroy_outlet(Info* outlet) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    --fake_lsl()->outlets;
    delete outlet;
}
LSL_CALL std::int32_t lsl_push_sample_strtp(Info* outlet, const char** values, double time_s,
                                            std::int32_t through) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "push", through);
    (*outlet)->pushed.push_back({time_s, values[0], {}});
    return fake_lsl()->refused == "push" ? -4 : 0;
}
LSL_CALL std::int32_t lsl_push_sample_dtp(Info* outlet, const double* values, double time_s,
                                          std::int32_t through) {
    const std::scoped_lock lock(fake_lsl()->mutex);
    note(*fake_lsl(), "push", through);
    (*outlet)->pushed.push_back({time_s, {}, std::vector<double>(values, values + (*outlet)->channels)});
    return 0;
}

} // extern "C"
