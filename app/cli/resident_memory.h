/// How much memory this process holds.
#pragma once

namespace overt {

/// What is resident, in MB (10^6 bytes); what the allocator keeps for later is given back first.
double resident_memory_mb();

/// The most that this process held since it began or since that was last reset, in MB; 0 where the kernel
/// does not say.
double peak_memory_mb();
void reset_peak_memory();

} // namespace overt
