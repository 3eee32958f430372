// A loop over independent items in contiguous shares. Shares depend on the number of threads alone,
// so equal inputs and thread counts give equal results.
#pragma once

#include <algorithm>
#include <thread>
#include <vector>

namespace retarget::solver {

// 0 means all cores.
inline int NumThreads(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Calls work(i, thread) for every i in [0, n).
template <typename Work>
void ParallelFor(int n, int threads, const Work& work) {
  threads = std::max(1, std::min(threads, n));
  const auto share = [&](int thread) {
    const int first = static_cast<int>(static_cast<long>(n) * thread / threads);
    const int last = static_cast<int>(static_cast<long>(n) * (thread + 1) / threads);
    for (int i = first; i < last; ++i) work(i, thread);
  };
  std::vector<std::thread> others;
  for (int thread = 1; thread < threads; ++thread) others.emplace_back(share, thread);
  share(0);
  for (std::thread& other : others) other.join();
}

}  // namespace retarget::solver
