#pragma once

namespace glint {

/// Configures glibc to keep freed memory, to use one heap and to request it in huge pages. On a
/// virtual machine the first touch of a 4 KiB page costs 10 to 17 us, and a software renderer
/// touches tens of megabytes: without this, most of the time for a cold picture is page faults
/// (figures in docs/framebuffer.md). Call it first in main; a no-op with another C library.
void adviseHeap();

}  // namespace glint
