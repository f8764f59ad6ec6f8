#pragma once

#include <cstddef>
#include <functional>

namespace isophote {

/// How a host runs a loop: calls body(begin, end) for pieces that together cover [0, count), each index once, on any
/// thread and in any order, and returns when all are done. `grain` is the least piece worth a thread. Nothing here
/// depends on how the pieces fall: results are the same for every implementation.
using ParallelFor = std::function<void(std::size_t count, std::size_t grain,
                                       const std::function<void(std::size_t, std::size_t)>& body)>;

/// The loop on the calling thread.
ParallelFor serial_for();

/// The loop on `threads` standard threads, started anew at each call. For hosts without a scheduler, and for tests.
/// The first exception thrown by a body is rethrown by the loop.
ParallelFor thread_for(int threads);

}  // namespace isophote
