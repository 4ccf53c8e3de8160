#pragma once

namespace naolcm {
class image_t;
}

namespace nao::camera {

class JpegEncoder;
struct CameraFrame;
struct ImageRequest;

/** Limit of an encoded image_t, bytes: it must fit into one UDP datagram (65507 bytes) with LCM's
 * own header and the channel name. */
inline constexpr int kMaxMessageBytes = 65000;

/** Message with one size of a frame.
 * @param request  Gives width and quality. @param default_quality  Used if the request gives none.
 * @throws Error  if the image does not fit into a message. */
naolcm::image_t encode_image(const CameraFrame& frame, const ImageRequest& request,
                             int default_quality, JpegEncoder& encoder);

}  // namespace nao::camera
