// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace enfilade {

/// Starts a new measurement of PeakMemoryMb where the system allows it (Linux); elsewhere the peak
/// is that of the whole process.
void ResetPeakMemory();

/// The most resident memory since the last reset, in MB (10^6 bytes).
[[nodiscard]] double PeakMemoryMb();

/// Memory that new allocations can take without swapping, in MB; 0 when unknown.
[[nodiscard]] double AvailableMemoryMb();

}  // namespace enfilade
