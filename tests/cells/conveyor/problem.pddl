; Five boxes arrive in the order b1 .. b5. Chute 2 is loaded from the back of a van: it wants b4 before b2, although b2
; comes first, so b2 has to go round. Chute 1 wants b3 before b1.
(define (problem orders)
  (:domain sorting-line)
  (:objects
    b1 b2 b3 b4 b5 nobody - box
    n1 n2 n3 n4 n5 n6 - place
    in r d1 d2 e t1 t - zone
    c1 c2 c3 - chute)
  (:init
    (safe)
    (infeed in) (reads r)
    (leads in r) (leads r d1) (leads d1 d2) (leads d2 e) (leads t1 t)
    (crosses e t1) (crosses t r)
    (diverts d1 c1) (diverts d2 c2) (ends e c3)
    (links in r) (links r d1) (links d1 d2) (links d2 e) (links t1 t) (links e t1) (links t r)
    (leaves d1 c1) (leaves d2 c2) (leaves e c3)
    (free in) (free r) (free d1) (free d2) (free e) (free t1) (free t)
    (next n1)
    (announced b1 n1) (announced b2 n2) (announced b3 n3) (announced b4 n4) (announced b5 n5)
    (follows n2 n1) (follows n3 n2) (follows n4 n3) (follows n5 n4) (follows n6 n5)
    (wanted b1 c1) (wanted b2 c2) (wanted b3 c1) (wanted b4 c2) (wanted b5 c3)
    (turn b1 b3) (turn b2 b4) (turn b3 nobody) (turn b4 nobody) (turn b5 nobody)
    (sorted nobody)
    (= (number b1) 1) (= (number b2) 2) (= (number b3) 3) (= (number b4) 4) (= (number b5) 5) (= (number nobody) 0)
    (= (shown in) 0) (= (shown r) 0) (= (shown d1) 0) (= (shown d2) 0) (= (shown e) 0) (= (shown t1) 0) (= (shown t) 0)
    (= (got c1) 0) (= (got c2) 0) (= (got c3) 0)
    (= (entered c1) 0) (= (entered c2) 0) (= (entered c3) 0)
    (= (distance in r) 1) (= (distance r d1) 1) (= (distance d1 d2) 1) (= (distance d2 e) 1)
    (= (distance e t1) 1) (= (distance t1 t) 3) (= (distance t r) 1)
    (= (travel) 0))
  (:goal (and (sorted b1) (sorted b2) (sorted b3) (sorted b4) (sorted b5)))
  (:metric minimize (travel)))
