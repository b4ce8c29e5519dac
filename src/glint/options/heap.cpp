#include "glint/options/heap.h"

#include <cstdlib>  // for __GLIBC__

#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <limits>
#endif

namespace glint {

void adviseHeap() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_ARENA_MAX, 1);
  // Extends the heap by a block of address space, not yet memory. A limit on either (ulimit -v,
  // strict overcommit accounting) may leave less.
  constexpr std::uintptr_t page = 2 << 20;
  for (const int block : {1 << 30, 256 << 20}) {
    mallopt(M_TOP_PAD, block);
    const auto begin = reinterpret_cast<std::uintptr_t>(sbrk(0));
    void* volatile grown = std::malloc(std::size_t(1) << 20);
    std::free(grown);
    const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
    if (end < begin + std::uintptr_t(block)) continue;
    const std::uintptr_t first = (begin + page - 1) / page * page;
    madvise(reinterpret_cast<void*>(first), (end - first) / page * page, MADV_HUGEPAGE);
    return;
  }
  mallopt(M_TOP_PAD, 128 << 10);
#endif
}

}  // namespace glint
