/// The library of the Lab Streaming Layer (liblsl), loaded while the program runs: Debian has no package of
/// it. Declared here are the functions of its C interface that are used, by their public names
/// (https://labstreaminglayer.readthedocs.io).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "devices/link/shared_library.h"

namespace overt {

struct LslStreamInfo; ///< the library's own objects
struct LslStreamInlet;
struct LslStreamOutlet;
struct LslXml;

/// Of lsl_create_streaminfo.
enum class LslFormat : std::int32_t { float32 = 1, double64 = 2, string = 3 };

/// Error codes.
inline constexpr std::int32_t lsl_timed_out = -1, lsl_lost = -2;

/// Functions that are optional are nothing where a version of the library lacks them.
class LslLibrary {
  public:
    /// Throws DeviceError if there is no library, or if it lacks functions, which are named.
    explicit LslLibrary(const SharedLibrary& library);

    const std::string& file() const noexcept { return file_; }
    /// Such as 116 for 1.16; 0 where the library does not tell.
    int version() const noexcept { return library_version ? library_version() : 0; }

    double (*local_clock)() = nullptr;
    std::int32_t (*library_version)() = nullptr; ///< optional

    std::int32_t (*resolve_byprop)(LslStreamInfo** buffer, std::uint32_t size, const char* property,
                                   const char* value, std::int32_t minimum, double timeout_s) = nullptr;
    std::int32_t (*resolve_all)(LslStreamInfo** buffer, std::uint32_t size, double wait_s) = nullptr;
    LslStreamInfo* (*create_streaminfo)(const char* name, const char* type, std::int32_t channels,
                                        double rate_hz, std::int32_t format, const char* source_id) = nullptr;
    void (*destroy_streaminfo)(LslStreamInfo*) = nullptr;
    const char* (*get_name)(LslStreamInfo*) = nullptr;
    const char* (*get_type)(LslStreamInfo*) = nullptr;
    const char* (*get_source_id)(LslStreamInfo*) = nullptr;
    const char* (*get_hostname)(LslStreamInfo*) = nullptr;
    const char* (*get_uid)(LslStreamInfo*) = nullptr;
    std::int32_t (*get_channel_count)(LslStreamInfo*) = nullptr;
    std::int32_t (*get_channel_format)(LslStreamInfo*) = nullptr;
    double (*get_nominal_srate)(LslStreamInfo*) = nullptr;

    LslXml* (*get_desc)(LslStreamInfo*) = nullptr;
    LslXml* (*child)(LslXml*, const char* name) = nullptr;
    LslXml* (*next_sibling_n)(LslXml*, const char* name) = nullptr;
    std::int32_t (*empty)(LslXml*) = nullptr;
    const char* (*child_value_n)(LslXml*, const char* name) = nullptr;
    LslXml* (*append_child)(LslXml*, const char* name) = nullptr;
    LslXml* (*append_child_value)(LslXml*, const char* name, const char* value) = nullptr;

    LslStreamInlet* (*create_inlet)(LslStreamInfo*, std::int32_t buffered_s, std::int32_t chunk,
                                    std::int32_t recover) = nullptr;
    void (*destroy_inlet)(LslStreamInlet*) = nullptr;
    LslStreamInfo* (*get_fullinfo)(LslStreamInlet*, double timeout_s, std::int32_t* error) = nullptr;
    void (*open_stream)(LslStreamInlet*, double timeout_s, std::int32_t* error) = nullptr;
    double (*pull_sample_d)(LslStreamInlet*, double* values, std::int32_t count, double timeout_s,
                            std::int32_t* error) = nullptr;
    double (*time_correction)(LslStreamInlet*, double timeout_s, std::int32_t* error) = nullptr;
    double (*time_correction_ex)(LslStreamInlet*, double* remote_s, double* uncertainty_s, double timeout_s,
                                 std::int32_t* error) = nullptr; ///< optional

    LslStreamOutlet* (*create_outlet)(LslStreamInfo*, std::int32_t chunk, std::int32_t buffered_s) = nullptr;
    void (*destroy_outlet)(LslStreamOutlet*) = nullptr;
    std::int32_t (*push_sample_strtp)(LslStreamOutlet*, const char** values, double time_s,
                                      std::int32_t push_through) = nullptr;
    std::int32_t (*push_sample_dtp)(LslStreamOutlet*, const double* values, double time_s,
                                    std::int32_t push_through) = nullptr;

  private:
    std::string file_;
};

/// From `file`; if that is empty, from OVERT_LSL_LIBRARY, or the system's. Throws DeviceError.
std::shared_ptr<const LslLibrary> load_lsl(const std::string& file);

/// Own an object of the library. The library must outlive them.
struct LslRelease {
    const LslLibrary* library;
    void operator()(LslStreamInfo* info) const { library->destroy_streaminfo(info); }
    void operator()(LslStreamInlet* inlet) const { library->destroy_inlet(inlet); }
    void operator()(LslStreamOutlet* outlet) const { library->destroy_outlet(outlet); }
};
template <class Object> using LslOwned = std::unique_ptr<Object, LslRelease>;

} // namespace overt
