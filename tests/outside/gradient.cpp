// gradient PLANTED PICTURE: a program that writes a picture.

#include "gradient.h"

#include <cstdlib>
#include <iostream>

#include "glint/image/error.h"
#include "glint/image/picture_writer.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "gradient PLANTED PICTURE\n";
    return 2;
  }
  try {
    const glint::Image image = gradient(std::atoi(argv[1]));
    const auto writer = glint::openPictureWriter(argv[2], image.width, image.height);
    writer->write(image);
    writer->finish();
  } catch (const glint::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
