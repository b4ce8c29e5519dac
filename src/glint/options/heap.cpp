#include "glint/options/heap.h"

#include <cstdlib>  // tells which C library this is

#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace glint {

void adviseHeap() {
#if defined(__GLIBC__)
  constexpr int keep = 1 << 30, block = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, keep);
  mallopt(M_TRIM_THRESHOLD, keep);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TOP_PAD, block);
  // Grows the heap by the block: addresses, not yet memory.
  void* volatile grown = std::malloc(std::size_t(1) << 20);
  std::free(grown);
  constexpr std::uintptr_t page = 2 << 20;
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(sbrk(0)) / page * page;
  madvise(reinterpret_cast<void*>(end - block + page), block - page, MADV_HUGEPAGE);
#endif
}

}  // namespace glint
