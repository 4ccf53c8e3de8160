# Debian's OpenCV package for CMake needs all of OpenCV; only these components are installed. Without them vision is left out,
# and policies are refused.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
find_library(OPENCV_dnn_LIBRARY opencv_dnn)
if(OPENCV_INCLUDE_DIR AND OPENCV_dnn_LIBRARY)
  foreach(component core imgproc imgcodecs dnn)
    find_library(OPENCV_${component}_LIBRARY opencv_${component} REQUIRED)
    add_library(opencv_${component} INTERFACE IMPORTED GLOBAL)
    target_include_directories(opencv_${component} SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
    target_link_libraries(opencv_${component} INTERFACE ${OPENCV_${component}_LIBRARY})
  endforeach()
endif()
