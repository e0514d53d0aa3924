// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace enfilade {
namespace {

// The value of "<key>: N kB" in a file of /proc, in MB; 0 when it is not there.
double ReadProcMb(const char* file_name, const std::string& key) {
  std::ifstream file(file_name);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key + ":")) return std::stod(line.substr(key.size() + 1)) * 1024e-6;
  }
  return 0;
}

}  // namespace

void ResetPeakMemory() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
}

double PeakMemoryMb() {
  const double since_reset = ReadProcMb("/proc/self/status", "VmHWM");
  if (since_reset > 0) return since_reset;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

double AvailableMemoryMb() { return ReadProcMb("/proc/meminfo", "MemAvailable"); }

}  // namespace enfilade
