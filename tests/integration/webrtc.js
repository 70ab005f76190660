// Makes WebRTC connect to a port of this machine over TCP and send first: to a peer (ICE; `server` is
// "PROTOCOL:ADDRESS:PORT" of a candidate, `name` the peer's name, chosen by the page) or to a relay (TURN;
// `server` is a URL). It returns before the connection is established.
async (server, name) => {
  const isRelay = server.startsWith("turn");
  const iceServers = isRelay ? [{urls: server, username: name, credential: name}] : [];
  const peer = new RTCPeerConnection({iceServers});
  (globalThis.peers ??= []).push(peer);  // a peer without a reference is closed
  peer.createDataChannel("any");
  const offer = await peer.createOffer();
  await peer.setLocalDescription(offer);
  if (isRelay) return;
  const [protocol, address, port] = server.split(":");
  const other = new RTCPeerConnection();
  await other.setRemoteDescription(offer);
  const {sdp} = await other.createAnswer();
  other.close();
  await peer.setRemoteDescription({type: "answer", sdp: sdp.replace(/(a=ice-ufrag:).*/, `$1${name}`)});
  const candidate = `candidate:1 1 ${protocol} 2105458943 ${address} ${port} typ host tcptype passive`;
  await peer.addIceCandidate({candidate, sdpMid: "0"});
}
