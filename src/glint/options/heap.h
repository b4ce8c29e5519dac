#pragma once

namespace glint {

/// Tells glibc to keep freed memory, to take all from one heap and to ask for it in huge pages.
/// On a virtual machine a first touch of a 4 KiB page costs 10 to 17 us, and a software renderer
/// touches tens of megabytes: without this most of a cold picture is page faults (figures in
/// docs/framebuffer.md). Call it first of all in main; does nothing with another C library.
void adviseHeap();

}  // namespace glint
